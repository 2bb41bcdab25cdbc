#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "slam/ekf/bearing_model.hpp"
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

/// An azimuth with the camera's offsets taken out.
struct CorrectedAzimuth {
  double azimuth_rad;
  Eigen::RowVector2d by_centre_rad_per_px;  ///< d(azimuth) / d(centre offset)
};

/// How the camera differs from its description: constants, or blocks of the state.
struct CameraOffsets {
  double yaw_rad = 0.0;  ///< robot azimuth = camera azimuth + yaw; while there is no block for it
  std::optional<Index> yaw_block;
  /// Where the optical axis meets the image, from where it was thought to be [px]: (towards azimuth 0, towards
  /// azimuth pi/2).
  std::optional<Index> centre_block;

  /// With q = r (cos z, sin z) the pixel seen from the assumed centre, the axis at e sees it under atan2(q - e).
  /// A bearing without a radius does not care. `mean(entry)` gives the state.
  template <class Mean>
  CorrectedAzimuth correct(double azimuth_rad, double radius_px, const Mean& mean) const {
    const double turn_rad = yaw_block ? mean(*yaw_block) : yaw_rad;
    if (!centre_block || std::isnan(radius_px)) return {azimuth_rad + turn_rad, Eigen::RowVector2d::Zero()};
    const double x_px = radius_px * std::cos(azimuth_rad) - mean(*centre_block);
    const double y_px = radius_px * std::sin(azimuth_rad) - mean(*centre_block + 1);
    const double r2 = std::max(x_px * x_px + y_px * y_px, kNearCentre_px * kNearCentre_px);
    return {std::atan2(y_px, x_px) + turn_rad, {y_px / r2, -x_px / r2}};
  }

  static constexpr double kNearCentre_px = 2.0;  ///< nearer pixels say nothing of the azimuth
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
    const Eigen::RowVector2d by_centre = -seen.by_centre_rad_per_px;
    if (offsets.centre_block) row.add(*offsets.centre_block, {by_centre.data(), 2});
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
