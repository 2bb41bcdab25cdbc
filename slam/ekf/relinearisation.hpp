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
  Index pose = JointState::kPose;  ///< block of the pose it was taken from: the robot's, or a clone's
  Index landmark = 0;              ///< block of the landmark
  BlockKind kind = BlockKind::point;
  double azimuth_rad = 0.0;  ///< measured in the camera's frame
  double variance_rad2 = 0.0;
  double radius_px = std::numeric_limits<double>::quiet_NaN();  ///< see Bearing
};

/// Innovation and Jacobian of one sighting, `mean(entry)` giving the state to linearise at. Nothing when the landmark
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

/// Finds where to linearise a batch of sightings: the posterior mean of an iterated update, computed on the few
/// entries the sightings touch. This finds the mode of the posterior, which stands for it well only while the prior is
/// narrow: with a heading uncertain by more than a few degrees the mode commits to one of several explanations, and
/// the filter does better with the prior's linearisation. The Gauss-Newton step is taken from the prior each time, so
/// the prior is used once.
///
/// Thread contract: thread-bound; does not allocate once its workspace has grown to the largest batch.
class Relinearisation {
 public:
  struct Settings {
    int max_iterations;                ///< 1: linearise at the prior mean
    double iterate_below_heading_rad;  ///< with a less certain heading, linearise at the prior mean
    double min_distance_m;
    JointState::Retraction retraction;
  };

  /// Writes into `rows` one row per sighting, to be applied to `state` by a single linear update: Jacobians at the
  /// final iterate, innovations referred to the prior mean. False when the iteration breaks down (it runs away from the
  /// prior, or a sighting stops being usable on the way); `rows` are then linearised at the prior mean.
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

  std::vector<Index> entries_;      // global entries of the sub-state, robot's pose first
  std::size_t free_ = 0;            // of them, the first so many: the rest is held
  std::vector<Index> local_of_;     // inverse of entries_
  std::vector<std::uint8_t> is_x_;  // entry starts a position
  std::vector<double> prior_, mean_, delta_;
  Workspace P_, PHt_, S_, innovation_;
};

}  // namespace azimuth
