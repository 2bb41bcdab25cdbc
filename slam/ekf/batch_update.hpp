#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "slam/ekf/block_triangle.hpp"
#include "slam/ekf/column_sum.hpp"
#include "slam/ekf/observation_row.hpp"

namespace azimuth {

/// Computes the gain K of a Kalman update that uses all measurements of a step at once (mathematics I.7). The gain is
/// kept in whitened form: the innovations nu have the covariance S = H P H^T + R = L L^T, where L is lower triangular,
/// and this class holds W = P H^T L^-T and the whitened innovations L^-1 nu. From these the correction of the state is
/// K nu = W (L^-1 nu), and the covariance P shrinks by K S K^T = W W^T. The caller makes P shrink with subtract_from().
/// Before that it may append a pair of columns (u, v) to W, for which u v^T + v u^T is subtracted too.
///
/// Thread contract: thread-bound. Nothing allocates unless the state or the batch is larger than any before.
class BatchUpdate {
 public:
  static constexpr Index kSpareColumns = 2;  ///< Room for one more pair of columns

  /// Makes room for states of the capacity of P.
  void fit(const BlockTriangle& P);

  /// Computes W, L and the whitened innovations. Returns false when S is not positive definite.
  bool compute(const BlockTriangle& P, std::span<const ObservationRow> rows);

  using Column = Eigen::Map<Eigen::VectorXd>;
  Column W(Index column) { return {W_.data() + column * stride_, extent_}; }
  /// Element of the lower triangular L.
  double L(Index row, Index column) const { return S_(row, column); }
  double whitened_innovation(Index row) const { return whitened_innovation_(row); }
  /// x += K nu.
  void add_correction(Index rows, double* x);
  /// column -= W W(entry, :)^T, using the first `columns` of W: the update's change of an entry's column of the
  /// covariance.
  void subtract_products_with(Index entry, Index columns, double* column);
  Index most_rows() const { return S_.rows(); }

  /// P <- P - w w^T for the first `squares` columns w of W, and P <- P - (u v^T + v u^T) for the `pairs` of columns
  /// after them.
  void subtract_from(BlockTriangle& P, Index squares, Index pairs) {
    subtract_symmetric_product(P.lower(), {W_.data(), stride_, squares, pairs});
  }

 private:
  struct PlacedPart {
    ObservationRow::Part part;
    Index row = 0;  // row of the measurement
  };
  void reserve(Index rows);
  void compute_gain(const BlockTriangle& P, std::span<const ObservationRow> rows);
  void add_columns_below(const BlockTriangle& P, const ObservationRow& row, double* out);
  void scale_columns(const BlockTriangle& P, const ObservationRow::Part& part, Index row);
  void add_rows_left(const BlockTriangle& P, std::span<const ObservationRow> rows);
  void sort_parts(std::span<const ObservationRow> rows);
  /// out += W f, where `factor` returns the element of f for a column.
  template <class Factor>
  void add_products(Index columns, Factor factor, double* out);
  bool whiten(std::span<const ObservationRow> rows);

  Index stride_ = 0, extent_ = 0;
  std::vector<PlacedPart> parts_;  // parts of all rows, sorted by offset
  AlignedVector W_;                // columns are `stride_` apart
  Eigen::MatrixXd S_;              // innovation covariance, then its Cholesky factor L
  Eigen::VectorXd whitened_innovation_;
  Eigen::VectorXd factors_;
  std::vector<ScaledColumns> scaled_;  // operands of the present sum
};

}  // namespace azimuth
