#pragma once
#include <azimuth/expectations_t.hpp>
#include <azimuth/sightings_t.hpp>
#include <chrono>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>

#include "slam/estimator/rig.hpp"
#include "slam/sample/bearings.hpp"
#include "tools/view/pace.hpp"

namespace azimuth {

/// The bearings of the newest image. They wait a short time for the result of the data association.
///
/// Thread contract: thread-bound. Stores at most `most` bearings of one image.
class ShownBearings {
 public:
  using Clock = Pace::Clock;

  explicit ShownBearings(std::size_t most) : most_(most) {}

  void take(BearingSet set, Clock::time_point now);
  void take(const sightings_t& sightings);
  void take(const expectations_t& expectations) { expectations_ = expectations; }
  /// Sets direction and offset of azimuths on the robot. Null: azimuths stay unchanged.
  void take_rig(const Rig* rig);
  /// Removes the data of the previous daemon session. The rig stays.
  void clear();

  bool waits() const { return pace_.waits; }
  Clock::time_point due() const;  ///< time of sending; only valid while waits() is true
  /// Marks the bearings as sent and returns the JSON members "trouble", "bearings": [[azimuth in the robot's frame,
  /// elevation, identity, kind, fate, landmark]], "expected": [[landmark, azimuth in the robot's frame, sigma,
  /// elevation, gate]]. "expected" is empty without expectations for this image.
  nlohmann::json sent(Clock::time_point now);
  Stamp stamp() const { return bearings_ ? bearings_->stamp : Stamp{}; }

 private:
  bool knows_fates() const;
  nlohmann::json expected() const;
  double in_robot_frame(double azimuth_rad) const;

  std::size_t most_;
  bool clockwise_ = false;
  double yaw_offset_rad_ = 0.0;
  std::optional<BearingSet> bearings_;
  Clock::time_point wait_since_{};
  std::optional<sightings_t> sightings_, sightings_before_;
  std::optional<expectations_t> expectations_;
  Pace pace_{std::chrono::milliseconds(66)};  // 15 per second
};

}  // namespace azimuth
