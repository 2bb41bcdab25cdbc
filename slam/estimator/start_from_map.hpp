#pragma once
// How an estimator starts from a saved map: whether map and rig fit, and at which pose the robot starts.

#include <Eigen/Core>
#include <optional>
#include <string_view>
#include <utility>

#include "slam/estimator/map_start.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/localisation/relocaliser.hpp"

namespace azimuth {

/// Which part of the system names landmarks on this rig.
MapNames names_of(const Rig& rig);

/// Why this rig cannot tell apart the landmarks of `map`, given how they are named. Nothing when it can.
std::optional<std::string_view> why_names_do_not_fit(const MapSnapshot& map, const Rig& rig);

/// Error text: a map of indistinguishable landmarks cannot be used to find an unknown start pose.
inline constexpr std::string_view kPoseIsNeeded =
    "landmarks without names or looks do not tell a robot where it is: say map.pose_known = true when it knows";

/// What is known of the start pose when odometry does not continue from the saved pose.
struct StartPose {
  bool known = false;  ///< The robot is near the pose at which the map was saved
  /// Covariance of (x [m], y [m], heading [rad]) of the robot's displacement since the map was saved.
  Eigen::Matrix3d moved = Eigen::Matrix3d::Zero();
  std::optional<PositionPrior> within;  ///< Search area if the pose is not known; nothing: anywhere
};
StartPose start_pose(const MapStart& start);

/// Decides when an estimator that starts from a saved map sets its initial pose: at once, or after odometry has said
/// whether it continues from the saved pose (Estimator::odometry_begins). The estimator provides `begin_at(const
/// StartPose&)`, which sets the pose.
///
/// Thread contract: thread-bound.
class MapStartDecision {
 public:
  /// Whether the map may change. Also true when there was no saved map.
  bool extends() const { return mode_ == MapMode::extend; }

  template <class BeginAt>
  void begin(const MapStart& start, BeginAt&& begin_at) {
    mode_ = start.mode;
    if (start.asks_odometry)
      undecided_ = start_pose(start);
    else
      begin_at(start_pose(start));
  }

  /// Returns true when the estimator keeps the pose at which the map was saved.
  template <class BeginAt>
  bool odometry_begins(bool goes_on, BeginAt&& begin_at) {
    const std::optional<StartPose> pose = std::exchange(undecided_, std::nullopt);
    if (pose && !goes_on) begin_at(*pose);
    return pose && goes_on;
  }

 private:
  MapMode mode_ = MapMode::extend;
  std::optional<StartPose> undecided_;  ///< Set until odometry begins
};

}  // namespace azimuth
