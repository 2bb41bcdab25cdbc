#pragma once
// Intervals of the periodic work of the stages.

#include <chrono>
#include <optional>

namespace azimuth {

/// Longest sleep of a stage that has nothing to do. The stage sends a heartbeat at least this often.
inline constexpr std::chrono::milliseconds kNap{100};

/// Interval at which the odometry that the next start goes on with is handed to the keeper.
inline constexpr std::chrono::milliseconds kHandOverInterval{250};

/// Shortest interval between two images for which the expected bearings are published. It is shorter than the image
/// interval of a 30 Hz camera, so no image of such a camera is left out.
inline constexpr std::chrono::milliseconds kExpectedInterval{30};

/// Decides when a stage publishes its status: on the first call, at once when its condition changes, and otherwise once
/// a second to update the counters.
///
/// Thread contract: thread-bound. Nothing allocates.
template <class Condition>
class StatusPace {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr Clock::duration kInterval = std::chrono::seconds(1);

  /// True: the status is to be published now. The call then records `condition` as published.
  bool due(const Condition& condition, Clock::time_point now) {
    if (!is_change(condition) && now < next_) return false;
    told_ = condition;
    next_ = now + kInterval;
    return true;
  }
  /// True: the condition published last is a different one, or none has been published yet.
  bool is_change(const Condition& condition) const { return told_ != condition; }

 private:
  std::optional<Condition> told_;
  Clock::time_point next_{};
};

}  // namespace azimuth
