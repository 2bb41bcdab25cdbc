#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace azimuth {

/// Index of a block of unknowns that are eliminated together: a pose, a landmark, a height, or the calibration.
using Block = std::int32_t;

/// A part of the normal matrix during assembly: the lower triangle of the rows of some blocks.
///
/// Thread contract: thread-bound.
class FrontMatrix {
 public:
  static constexpr int kNotHere = -1;

  /// Local row of a row of the whole matrix; kNotHere when the row is not in this part.
  int row_of(int whole_row) const { return places_[static_cast<std::size_t>(whole_row)]; }

  /// Adds a b^T at (row, column), or its mirror image when that lies in the lower triangle.
  template <class A, class B>
  void add_product(int row, const A& a, int column, const B& b) {
    if (row >= column)
      values_.block(row, column, a.rows(), b.rows()) += a * b.transpose();
    else
      values_.block(column, row, b.rows(), a.rows()) += b * a.transpose();
  }
  template <class Matrix>
  void add(int row, int column, const Matrix& matrix) {
    if (row >= column)
      values_.block(row, column, matrix.rows(), matrix.cols()) += matrix;
    else
      values_.block(column, row, matrix.cols(), matrix.rows()) += matrix.transpose();
  }

  /// Whether the factor computed from this matrix is kept. If so, terms remember the point at which they were
  /// linearised.
  bool is_kept() const { return kept_; }

  // The members below are for the code that assembles and factorises the matrix.
  using Values = Eigen::Map<Eigen::MatrixXd>;

  /// Sets the matrix to zero, with these rows of a whole matrix that has `whole_rows` rows.
  void begin(const std::vector<int>& rows, std::size_t whole_rows, bool kept);
  void end(const std::vector<int>& rows);
  const Values& values() const { return values_; }
  Values& values() { return values_; }
  /// row_of() of each of the given rows. The result is valid until the next call.
  const std::vector<int>& rows_of(const int* whole_rows, int count) {
    some_rows_.resize(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) some_rows_[static_cast<std::size_t>(i)] = row_of(whole_rows[i]);
    return some_rows_;
  }

 private:
  std::vector<double> storage_;
  Values values_{nullptr, 0, 0};
  std::vector<int> places_;  // local row of each row of the whole matrix
  std::vector<int> some_rows_;
  bool kept_ = false;
};

/// A least-squares problem, seen as the normal matrix of its terms, which FrontTree factorises.
class NormalEquations {
 public:
  virtual ~NormalEquations() = default;

  virtual int rows() const = 0;             ///< of the whole matrix, unused rows included
  virtual int size(Block block) const = 0;  ///< number of rows of a block; 0: not, or no longer, an unknown
  virtual int first_row(Block block) const = 0;
  /// Rank in the order of elimination: a block of a lower rank is eliminated first. Blocks that future terms will
  /// involve should go last.
  virtual std::uint8_t rank(Block block) const = 0;

  /// Appends the blocks that share a term with `block`. Blocks may appear more than once, and blocks that are no
  /// unknowns may appear.
  virtual void append_neighbours(Block block, std::vector<Block>& out) const = 0;
  /// Adds the terms whose first block in `front` is `block`, that is, all other blocks of the term have higher local
  /// rows.
  virtual void add_terms(Block block, FrontMatrix& front) = 0;
};

}  // namespace azimuth
