#pragma once
// One step of a multifrontal Cholesky factorisation. A front is a dense matrix of a few blocks. Its first blocks are
// eliminated; the Schur complement of the other blocks is added to the parent front.

#include <Eigen/Core>
#include <vector>

#include "slam/smoother/normal_equations.hpp"

namespace azimuth {

/// The blocks and the child fronts of a front. A shape never changes.
struct FrontShape {
  std::vector<Block> blocks;  ///< in the order of their elimination
  std::size_t eliminated_blocks = 0;
  std::vector<int> rows;  ///< rows of all blocks in the whole matrix
  int eliminated = 0;     ///< number of rows eliminated here, the first ones
  std::vector<int> children;

  int size() const { return static_cast<int>(rows.size()); }
  int remaining() const { return size() - eliminated; }
};

/// The factorised matrix of a front.
struct FrontNumbers {
  Eigen::MatrixXd factor;    ///< columns of L, (all rows) x (eliminated); the upper triangle is undefined
  std::vector<double> rest;  ///< Schur complement of the remaining rows, lower triangle, column after column
  double least_pivot = 0.0;  ///< smallest entry of L's diagonal
};

/// Factorises the first `eliminated` columns as L L^T, in place. The remaining lower triangle becomes the Schur
/// complement. Returns false when the matrix is not positive definite.
bool eliminate_columns(Eigen::Map<Eigen::MatrixXd>& values, int eliminated);

/// Adds a child's Schur complement to its parent's matrix.
void hand_over(const FrontShape& child, const std::vector<double>& rest, FrontMatrix& parent);

/// Computes y <- L^-1 y for the front's eliminated rows in each column of `whole`, and subtracts their contribution
/// from the remaining rows. `rows` has the place of each of the front's rows in `whole`; `local` is temporary storage.
void solve_forwards(const std::vector<int>& rows, const FrontNumbers& numbers, Eigen::Ref<Eigen::MatrixXd> whole,
                    Eigen::VectorXd& local);
/// Computes x <- L^-T y for the front's eliminated rows, given the solution of its remaining rows.
void solve_backwards(const FrontShape& shape, const FrontNumbers& numbers, Eigen::Ref<Eigen::VectorXd> whole,
                     Eigen::VectorXd& local);

}  // namespace azimuth
