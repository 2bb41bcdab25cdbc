#pragma once
// How often stages do what nothing else urges them to.

#include <chrono>
#include <optional>

namespace azimuth {

/// Longest sleep of a stage with nothing to do: it beats at least this often.
inline constexpr std::chrono::milliseconds kNap{100};

/// How often what the next start goes on with is handed to the keeper.
inline constexpr std::chrono::milliseconds kHandOverInterval{250};

/// How often what is expected of an image is told, at most: of all those of a camera that people look through.
inline constexpr std::chrono::milliseconds kExpectedInterval{30};

/// When a stage tells its status: at the start, at once when its condition changes, and once a second for what is
/// counted in it.
///
/// Thread contract: thread-bound. Nothing allocates.
template <class Condition>
class StatusPace {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr Clock::duration kInterval = std::chrono::seconds(1);

  /// Whether to tell it now, and then it counts as told.
  bool due(const Condition& condition, Clock::time_point now) {
    if (!is_change(condition) && now < next_) return false;
    told_ = condition;
    next_ = now + kInterval;
    return true;
  }
  /// Whether another one was told last, or none yet.
  bool is_change(const Condition& condition) const { return told_ != condition; }

 private:
  std::optional<Condition> told_;
  Clock::time_point next_{};
};

}  // namespace azimuth
