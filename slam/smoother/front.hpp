#pragma once
// A step of a multifrontal Cholesky factorisation: a dense matrix of a few blocks, of which the first ones are
// eliminated and the rest, with what that leaves, is handed to the parent.

#include <Eigen/Core>
#include <vector>

#include "slam/smoother/normal_equations.hpp"

namespace azimuth {

/// Which blocks, and which fronts hand over to this one. Never changes.
struct FrontShape {
  std::vector<Block> blocks;  ///< in the order of their elimination
  std::size_t eliminated_blocks = 0;
  std::vector<int> rows;  ///< of the whole matrix, of all blocks
  int eliminated = 0;     ///< rows of the blocks eliminated here, the first ones
  std::vector<int> children;

  int size() const { return static_cast<int>(rows.size()); }
  int remaining() const { return size() - eliminated; }
};

/// What became of its matrix.
struct FrontNumbers {
  Eigen::MatrixXd factor;    ///< columns of L, (all rows) x (eliminated); its upper part is of no meaning
  std::vector<double> rest;  ///< Schur complement of the remaining rows, lower triangle, column after column
  double least_pivot = 0.0;  ///< of L's diagonal
};

/// L L^T of the first `eliminated` columns, in place; the remaining lower triangle becomes the Schur complement. False:
/// not positive definite.
bool eliminate_columns(Eigen::Map<Eigen::MatrixXd>& values, int eliminated);

/// Adds what a front leaves to its parent's matrix.
void hand_over(const FrontShape& child, const std::vector<double>& rest, FrontMatrix& parent);

/// y <- L^-1 y on the front's rows of each column of `whole`, those of the remaining rows reduced. `rows`: where they
/// are in `whole`. `local` is storage.
void solve_forwards(const std::vector<int>& rows, const FrontNumbers& numbers, Eigen::Ref<Eigen::MatrixXd> whole,
                    Eigen::VectorXd& local);
/// x <- L^-T y on the front's rows, the remaining rows being solved.
void solve_backwards(const FrontShape& shape, const FrontNumbers& numbers, Eigen::Ref<Eigen::VectorXd> whole,
                     Eigen::VectorXd& local);

}  // namespace azimuth
