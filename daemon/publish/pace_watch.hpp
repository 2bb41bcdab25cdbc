#pragma once
#include <chrono>
#include <cstdint>
#include <string>

#include "daemon/publish/status.hpp"

namespace azimuth {

/// Notices when images or bearings come faster than they are worked off: those in between are left out, and the pose is
/// the vaguer for it. Told of the counters of a status now and then, it judges some seconds at a time.
///
/// Thread contract: thread-bound.
class PaceWatch {
 public:
  using Clock = std::chrono::steady_clock;

  void look(Clock::time_point now, const Status& status);
  /// For a person, with the way out; empty: all that comes is used.
  const std::string& text() const { return text_; }

 private:
  struct Counts {
    Clock::time_point at{};
    std::uint64_t looked = 0, replaced = 0, refused = 0, steps = 0;
  };
  static std::string judged(const Counts& before, const Counts& now, double detect_mean_us);

  Counts before_;
  std::string text_;
};

}  // namespace azimuth
