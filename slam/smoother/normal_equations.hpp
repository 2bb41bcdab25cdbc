#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace azimuth {

/// Unknowns that are eliminated together: a pose, a landmark, the calibration. An index, never used again.
using Block = std::int32_t;

/// A part of the normal matrix while it is put together: some blocks against each other, lower triangle.
///
/// Thread contract: thread-bound.
class FrontMatrix {
 public:
  static constexpr int kNotHere = -1;

  /// The row here of a row of the whole matrix; kNotHere when it is eliminated before.
  int row_of(int whole_row) const { return places_[static_cast<std::size_t>(whole_row)]; }

  /// Adds weights * a b^T at (row, column) and, being symmetric, its mirror.
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

  /// Whether the factor made of this is kept: terms remember then where they were linearised.
  bool is_kept() const { return kept_; }

  // What follows is for whoever puts it together.
  using Values = Eigen::Map<Eigen::MatrixXd>;

  /// Zero, of these rows of a whole matrix of `whole_rows`.
  void begin(const std::vector<int>& rows, std::size_t whole_rows, bool kept);
  void end(const std::vector<int>& rows);
  const Values& values() const { return values_; }
  Values& values() { return values_; }
  /// row_of() each of some rows; until the next call.
  const std::vector<int>& rows_of(const int* whole_rows, int count) {
    some_rows_.resize(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) some_rows_[static_cast<std::size_t>(i)] = row_of(whole_rows[i]);
    return some_rows_;
  }

 private:
  std::vector<double> storage_;
  Values values_{nullptr, 0, 0};
  std::vector<int> places_;  // of each row of the whole matrix
  std::vector<int> some_rows_;
  bool kept_ = false;
};

/// A sum of squares, seen as the normal matrix of its terms: what the front tree factorises.
class NormalEquations {
 public:
  virtual ~NormalEquations() = default;

  virtual int rows() const = 0;             ///< of the whole matrix, unused ones included
  virtual int size(Block block) const = 0;  ///< rows of a block; 0: it is no unknown, or no longer
  virtual int first_row(Block block) const = 0;
  /// Of two blocks that of the lower rank is eliminated first: what will be in terms to come goes last.
  virtual std::uint8_t rank(Block block) const = 0;

  /// Appends the blocks that share a term with `block`; some more than once, those that are no unknowns included.
  virtual void append_neighbours(Block block, std::vector<Block>& out) const = 0;
  /// Adds the terms of which `block` is the first one here: all others of the term have higher rows.
  virtual void add_terms(Block block, FrontMatrix& front) = 0;
};

}  // namespace azimuth
