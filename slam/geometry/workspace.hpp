#pragma once
#include <Eigen/Core>

namespace azimuth {

/// Reusable storage for matrices of varying size. It allocates only for a larger matrix than ever before, whereas
/// Eigen's resize() allocates whenever the number of elements changes.
///
/// Thread contract: thread-bound.
class Workspace {
 public:
  /// Returns an uninitialised matrix; the previous content is lost.
  Eigen::Map<Eigen::MatrixXd> matrix(Eigen::Index rows, Eigen::Index columns) {
    return {storage(rows * columns), rows, columns};
  }
  Eigen::Map<Eigen::VectorXd> vector(Eigen::Index size) { return {storage(size), size}; }

 private:
  double* storage(Eigen::Index size) {
    if (size > storage_.size()) storage_.resize(2 * size);
    return storage_.data();
  }
  Eigen::VectorXd storage_;
};

}  // namespace azimuth
