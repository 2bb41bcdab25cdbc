#pragma once
#include <chrono>
#include <cstdint>
#include <string>

#include "daemon/publish/status.hpp"

namespace azimuth {

/// Notices when images or bearings arrive faster than they are processed. Some of them are then skipped, and the pose
/// becomes less accurate. The caller passes the counters of the status now and then, and the watch judges them over
/// several seconds.
///
/// Thread contract: thread-bound.
class PaceWatch {
 public:
  using Clock = std::chrono::steady_clock;

  void look(Clock::time_point now, const Status& status);
  /// A message for a person that names a remedy; empty: all images and bearings are used.
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
