#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "slam/smoother/smoother.hpp"

namespace azimuth {

/// How uncertain the last poses are to each other, and where landmarks should be seen from them.
///
/// Thread contract: thread-safe once made.
class WindowBelief {
 public:
  /// Of the poses from `first` on and of `landmarks`, which all have bearings, as of the smoother's last optimise().
  WindowBelief(const Smoother& smoother, PoseId first, std::span<const LandmarkId> landmarks, double min_distance_m);

  PoseId first() const { return first_; }
  /// Covariance of a pose, along its own axes, if the newest one is taken as exact.
  const Eigen::Matrix3d& relative_to_newest(PoseId pose) const { return relative_[index(pose)]; }
  /// Variance of the azimuth that a landmark should be seen under; negative: not known, here or at all.
  double variance(PoseId pose, LandmarkId landmark) const;

 private:
  std::size_t index(PoseId pose) const { return static_cast<std::size_t>(pose - first_); }
  PoseId first_;
  std::size_t poses_;
  std::vector<Eigen::Matrix3d> relative_;
  std::vector<int> row_of_landmark_;  // -1: unknown
  std::vector<double> variances_;     // pose after pose, landmarks in the order given
  std::size_t landmarks_;
};

}  // namespace azimuth
