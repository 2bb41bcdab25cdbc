#pragma once
// Minimises the same sum of energies as a BearingGraph with a different method: one sparse matrix, assembled anew in
// each step. The solver is slow and simple; the tests compare the smoother with it.

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "slam/smoother/bearing_graph.hpp"

namespace azimuth {

/// Unknowns: for each pose except the first (along, left, turn); for each landmark with bearings (alpha, rho), and its
/// elevation tangent if it has elevations; then the unknown calibrations.
class BatchProblem {
 public:
  /// Takes the current measurements, associations and values of the graph; the graph must outlive this object.
  BatchProblem(const BearingGraph& graph, const SmootherSettings& settings);

  struct Normal {
    Eigen::SparseMatrix<double> H;  ///< lower triangle
    Eigen::VectorXd gradient;
    double energy = 0.0;
  };
  Normal normal() const;
  double energy() const { return normal().energy; }
  void move(const Eigen::VectorXd& step);
  /// Runs Gauss-Newton until no step is longer than `tolerance`, and damps the steps if the energy would rise. Returns
  /// the number of steps, or -1 if the solver does not converge.
  int solve(double tolerance = 1e-9, int most_steps = 1000);

  const BearingGraph::Values& values() const { return values_; }
  Eigen::Index row_of_pose(PoseId id) const { return 3 * (id - 1); }
  Eigen::Index row_of_landmark(LandmarkId id) const { return landmark_row_[static_cast<std::size_t>(id)]; }
  Eigen::Index rows() const { return rows_; }

 private:
  const BearingGraph& graph_;
  SmootherSettings settings_;
  BearingGraph::Values values_;
  std::vector<Eigen::Index> landmark_row_;
  std::array<double, kCalibrations> sigma_{};
  std::array<Eigen::Index, kCalibrations> calibration_row_{};
  Eigen::Index rows_ = 0;
};

/// Largest difference between `a` and `b` in any coordinate of any pose or landmark.
double largest_difference(const BearingGraph::Values& a, const BearingGraph::Values& b);

}  // namespace azimuth
