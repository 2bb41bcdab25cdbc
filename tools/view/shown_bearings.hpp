#pragma once
#include <azimuth/expectations_t.hpp>
#include <azimuth/sightings_t.hpp>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "slam/estimator/rig.hpp"
#include "slam/sample/bearings.hpp"
#include "tools/view/times.hpp"

namespace azimuth {

/// Result of the data association of a bearing.
struct BearingFate {
  std::string_view word = "unknown";  ///< "used", "refused", "new", "ambiguous", "thinned"
  std::optional<std::int64_t> landmark;
};

/// Numbers of bearings of one image by the estimator's counters.
struct ImageCounts {
  std::int64_t rejected = 0, ambiguous = 0, thinned = 0, created = 0;
};

/// The counts for the image of `now`: the differences from the message of the previous step. Nothing if that message is
/// missing.
std::optional<ImageCounts> counts_of(const sightings_t* before, const sightings_t& now);

/// One fate for each bearing of the set. A bearing contained in `sightings` was used. For the others, only the numbers
/// in `counts` are known: if a single kind accounts for all of them, each has that fate, otherwise "unknown".
/// `clockwise`: azimuths of the bearings grow clockwise (rig.toml). Reentrant.
std::vector<BearingFate> fates_of(const BearingSet& set, const sightings_t& sightings,
                                  const std::optional<ImageCounts>& counts, bool clockwise);

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
