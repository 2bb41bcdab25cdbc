#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "slam/smoother/smoother.hpp"

namespace azimuth {

/// Covariances of the last poses relative to each other, and the variances of the predicted azimuths of landmarks from
/// these poses.
///
/// Thread contract: thread-safe after construction.
class WindowBelief {
 public:
  /// Computes the covariances of the poses from `first` on and of `landmarks`, which must all have bearings, as of the
  /// smoother's last optimise().
  WindowBelief(const Smoother& smoother, PoseId first, std::span<const LandmarkId> landmarks, double min_distance_m);

  PoseId first() const { return first_; }
  /// Covariance of a pose along its own axes, relative to the newest pose.
  const Eigen::Matrix3d& relative_to_newest(PoseId pose) const { return relative_[index(pose)]; }
  /// Variance of the predicted azimuth of a landmark from a pose; negative when it is not known.
  double variance(PoseId pose, LandmarkId landmark) const;

 private:
  std::size_t index(PoseId pose) const { return static_cast<std::size_t>(pose - first_); }
  PoseId first_;
  std::size_t poses_;
  std::vector<Eigen::Matrix3d> relative_;
  std::vector<int> row_of_landmark_;  // -1: unknown
  std::vector<double> variances_;     // pose by pose, landmarks in the given order
  std::size_t landmarks_;
};

}  // namespace azimuth
