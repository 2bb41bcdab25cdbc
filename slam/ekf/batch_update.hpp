#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "slam/ekf/aligned_vector.hpp"
#include "slam/ekf/block_triangle.hpp"
#include "slam/ekf/column_sum.hpp"
#include "slam/ekf/observation_row.hpp"

namespace azimuth {

/// The gain of one batch update (SPEC I.7), whitened: with S = H P H^T + R = L L^T it holds W = P H^T L^-T and the
/// innovations L^-1 nu, so that K nu = W L^-1 nu and K S K^T = W W^T. The covariance is left to the caller, with room
/// for a pair of columns more in the product that it is to lose (rank_update.hpp).
///
/// Thread contract: thread-bound. Nothing allocates unless the state or the batch is larger than any before.
class BatchUpdate {
 public:
  static constexpr Index kSpareColumns = 2;  ///< one pair

  /// Makes room for states of this capacity.
  void fit(const BlockTriangle& P);

  /// False when S is not positive definite.
  bool compute(const BlockTriangle& P, std::span<const ObservationRow> rows);

  using Column = Eigen::Map<Eigen::VectorXd>;
  Column W(Index column) { return {W_.data() + column * stride_, extent_}; }
  /// Of L, the lower triangle.
  double L(Index row, Index column) const { return S_(row, column); }
  double whitened_innovation(Index row) const { return whitened_innovation_(row); }
  /// x += K nu.
  void add_correction(Index rows, double* x);
  /// column -= W W(entry, :)^T, of the first `columns` of W: what an entry's column of the covariance loses.
  void subtract_products_with(Index entry, Index columns, double* column);
  Index most_rows() const { return S_.rows(); }

  /// P <- P - w w^T for the first `squares` columns w of W, and P - (u v^T + v u^T) for the `pairs` after them.
  void subtract_from(BlockTriangle& P, Index squares, Index pairs) {
    subtract_symmetric_product(P.lower(), {W_.data(), stride_, squares, pairs});
  }

 private:
  struct PlacedPart {
    ObservationRow::Part part;
    Index row = 0;  // of the measurement
  };
  void reserve(Index rows);
  void compute_gain(const BlockTriangle& P, std::span<const ObservationRow> rows);
  void add_columns_below(const BlockTriangle& P, const ObservationRow& row, double* out);
  void scale_columns(const BlockTriangle& P, const ObservationRow::Part& part, Index row);
  void add_rows_left(const BlockTriangle& P, std::span<const ObservationRow> rows);
  void sort_parts(std::span<const ObservationRow> rows);
  /// out += W f with a factor for each column, one after the other.
  template <class Factor>
  void add_products(Index columns, Factor factor, double* out);
  bool whiten(std::span<const ObservationRow> rows);

  Index stride_ = 0, extent_ = 0;
  std::vector<PlacedPart> parts_;  // of all rows, by offset
  AlignedVector W_;                // columns `stride_` apart
  Eigen::MatrixXd S_;              // innovation covariance, then its Cholesky factor L
  Eigen::VectorXd whitened_innovation_;
  Eigen::VectorXd factors_;
  std::vector<ScaledColumns> scaled_;  // of the sum at hand
};

}  // namespace azimuth
