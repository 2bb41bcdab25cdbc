#pragma once
#include <optional>
#include <utility>

#include "slam/estimator/map_fitness.hpp"

namespace azimuth {

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
