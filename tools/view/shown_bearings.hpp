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

/// The newest image's bearings, which wait a moment for what became of them.
///
/// Thread contract: thread-bound. Knows one image, and no more of its bearings than `most`.
class ShownBearings {
 public:
  using Clock = Pace::Clock;

  explicit ShownBearings(std::size_t most) : most_(most) {}

  void take(BearingSet set, Clock::time_point now);
  void take(const sightings_t& sightings);
  void take(const expectations_t& expectations) { expectations_ = expectations; }
  /// How bearings lie on the robot; none: as they come.
  void take_rig(const Rig* rig);
  /// Of another daemon; the rig stays.
  void clear();

  bool waits() const { return pace_.waits; }
  Clock::time_point due() const;  ///< when they are to be sent; asked while they wait
  /// "trouble", "bearings": [[azimuth in the robot's frame, elevation, identity, kind, fate, landmark]], "expected":
  /// [[landmark, azimuth in the robot's frame, sigma, elevation, gate]], none where nothing was sent of this image.
  /// They wait no longer.
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
  Pace pace_{std::chrono::milliseconds(66)};  // 15 a second
};

}  // namespace azimuth
