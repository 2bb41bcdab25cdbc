#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "slam/ekf/bearing_model.hpp"
#include "slam/ekf/camera_offsets.hpp"
#include "slam/ekf/joint_state.hpp"
#include "slam/geometry/index.hpp"
#include "slam/geometry/workspace.hpp"

namespace azimuth {

/// One bearing of a landmark that is in the state.
struct MappedSighting {
  Index pose = JointState::kPose;  ///< Block of the pose it was taken from: the robot's or a clone's
  Index landmark = 0;              ///< Block of the landmark
  BlockKind kind = BlockKind::point;
  double azimuth_rad = 0.0;  ///< Measured, in the camera's frame
  double variance_rad2 = 0.0;
  double radius_px = std::numeric_limits<double>::quiet_NaN();  ///< See Bearing
};

/// Innovation and Jacobian of one bearing; `mean(entry)` returns the state to linearise at. Nothing when the landmark
/// is nearer than `min_distance_m`.
template <class Mean>
std::optional<ObservationRow> linearise(const MappedSighting& sighting, const CameraOffsets& offsets,
                                        double min_distance_m, const Mean& mean) {
  const Pose2 T_map_body{mean(sighting.pose), mean(sighting.pose + 1), mean(sighting.pose + 2)};
  const CorrectedAzimuth seen = offsets.correct(sighting.azimuth_rad, sighting.radius_px, mean);
  ObservationRow row;
  row.variance = sighting.variance_rad2;
  const auto fill = [&](const auto& predicted) {
    row.innovation = wrap(seen.azimuth_rad - predicted.azimuth_rad);
    row.add(sighting.pose, {predicted.by_pose.data(), 3});
    row.add(sighting.landmark, {predicted.by_landmark.data(), as_size(predicted.by_landmark.size())});
    const double by_yaw = -1.0;
    if (offsets.yaw_block) row.add(*offsets.yaw_block, {&by_yaw, 1});
    const Eigen::RowVector4d by_camera = -seen.by_camera;
    if (offsets.errors_block) row.add(*offsets.errors_block, {by_camera.data(), as_size(offsets.errors_size())});
  };
  const Index f = sighting.landmark;
  if (sighting.kind == BlockKind::point) {
    const auto predicted = predict_bearing(T_map_body, Eigen::Vector2d(mean(f), mean(f + 1)), min_distance_m);
    if (!predicted) return std::nullopt;
    fill(*predicted);
  } else {
    const InverseDepth ray{{mean(f), mean(f + 1)}, mean(f + 2), mean(f + 3)};
    const auto predicted = predict_bearing(T_map_body, ray, min_distance_m);
    if (!predicted) return std::nullopt;
    fill(*predicted);
  }
  return row;
}

/// Finds the linearisation point for a batch of bearings: the posterior mean of an iterated update, computed on the few
/// entries that the bearings involve. This is the mode of the posterior, which represents the posterior well only while
/// the prior is narrow: with a heading uncertain by more than a few degrees the mode commits to one of several
/// explanations, and linearising at the prior is better. Each Gauss-Newton step starts from the prior, so that the
/// prior is used once.
///
/// Thread contract: thread-bound; does not allocate once its workspace has grown to the largest batch.
class Relinearisation {
 public:
  struct Settings {
    int max_iterations;                ///< 1: linearise at the prior mean
    double iterate_below_heading_rad;  ///< With a larger sigma of the heading, linearise at the prior mean
    double min_distance_m;
    JointState::Retraction retraction;
  };

  /// Writes one row per bearing into `rows`, to be applied to `state` by a single linear update: Jacobians at the final
  /// iterate, innovations referred to the prior mean. Returns false when the iteration fails (it runs away from the
  /// prior, or a bearing becomes unusable); `rows` are then linearised at the prior mean.
  bool settle(const JointState& state, std::span<const MappedSighting> sightings, const CameraOffsets& offsets,
              const Settings& settings, std::vector<ObservationRow>& rows);

 private:
  using Rows = std::vector<ObservationRow>;
  void linearise_at_prior(const JointState& state, std::span<const MappedSighting> sightings,
                          const CameraOffsets& offsets, const Settings& settings, Rows& rows) const;
  void collect(const JointState& state, const Rows& rows);
  Index local(Index entry) const { return local_of_[as_size(entry)]; }
  bool step(const Rows& rows, double& change);
  void move_mean(JointState::Retraction retraction);
  bool refer_to_prior(std::span<const MappedSighting> sightings, const CameraOffsets& offsets, const Settings& settings,
                      Rows& rows);

  std::vector<Index> entries_;      // global entries of the sub-state, the robot's pose first
  std::size_t free_ = 0;            // number of entries_ that are not held; these come first
  std::vector<Index> local_of_;     // inverse of entries_
  std::vector<std::uint8_t> is_x_;  // whether the entry starts a position
  std::vector<double> prior_, mean_, delta_;
  Workspace P_, PHt_, S_, innovation_;
};

}  // namespace azimuth
