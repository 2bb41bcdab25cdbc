#pragma once
#include <optional>
#include <utility>

#include "slam/estimator/map_fitness.hpp"

namespace azimuth {

/// How an estimator begins on the map it starts from: at once, or when the odometry has said whether it goes on
/// (Estimator::odometry_begins). Where the robot begins is the estimator's to do: `begin_at(const StartPose&)`.
///
/// Thread contract: thread-bound.
class MapBeginning {
 public:
  /// The map may change. So it may where there was none.
  bool extends() const { return mode_ == MapMode::extend; }

  template <class BeginAt>
  void begin(const MapStart& start, BeginAt&& begin_at) {
    mode_ = start.mode;
    if (start.asks_odometry)
      undecided_ = start_pose(start);
    else
      begin_at(start_pose(start));
  }

  /// True: the pose goes on from where the map was saved.
  template <class BeginAt>
  bool odometry_begins(bool goes_on, BeginAt&& begin_at) {
    const std::optional<StartPose> pose = std::exchange(undecided_, std::nullopt);
    if (pose && !goes_on) begin_at(*pose);
    return pose && goes_on;
  }

 private:
  MapMode mode_ = MapMode::extend;
  std::optional<StartPose> undecided_;  ///< until the odometry has begun
};

}  // namespace azimuth
