#pragma once
// The same sum of energies as a BearingGraph's, by other means: one sparse matrix, put together anew for each step.
// Slow and plain, to compare with.

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "slam/smoother/bearing_graph.hpp"

namespace azimuth {

/// Unknowns: each pose but the first, (along, left, turn), then each landmark that has bearings, (alpha, rho) and its
/// tangent when it has elevations, then the calibrations that are unknown.
class BatchProblem {
 public:
  /// Measurements, associations and values of the moment; the graph must outlive it.
  BatchProblem(const BearingGraph& graph, const SmootherSettings& settings);

  struct Normal {
    Eigen::SparseMatrix<double> H;  ///< lower triangle
    Eigen::VectorXd gradient;
    double energy = 0.0;
  };
  Normal normal() const;
  double energy() const { return normal().energy; }
  void move(const Eigen::VectorXd& step);
  /// Gauss-Newton until no step is longer than `tolerance`, damped when the energy would rise. Steps taken; -1: it did
  /// not end.
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

/// Largest difference of any pose's or landmark's coordinates.
double largest_difference(const BearingGraph::Values& a, const BearingGraph::Values& b);

}  // namespace azimuth
