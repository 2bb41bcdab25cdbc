#pragma once
#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "base/ring.hpp"
#include "drivers/device/connection.hpp"

namespace azimuth {

/// What there is to tell of a device, for the log: every new trouble once until the device runs again, also when
/// several alternate.
///
/// Thread contract: thread-bound. Nothing allocates while the device runs.
class DeviceNews {
 public:
  /// `running` is what there is to tell when it runs, e.g. "odometry comes from /dev/ttyUSB0".
  explicit DeviceNews(std::string running = {}) : running_(std::move(running)) {}
  void call_running(std::string running) { running_ = std::move(running); }

  /// The state becomes this one. A device that is only starting still has the trouble it had, unless there is another.
  void enter(Connection connection, const std::string& trouble, DeviceState& state) {
    const Connection before = std::exchange(state.connection, connection);
    if (connection == Connection::starting && trouble.empty()) return;
    if (state.trouble != trouble) state.trouble = trouble;
    if (connection == Connection::running) {
      if (before != connection) tell(running_);
      told_.clear();
    } else {
      tell_once(trouble);
    }
  }
  void tell(std::string event) { events_.push(std::move(event)); }
  /// The oldest sentence not taken yet.
  bool take(std::string& event) { return events_.pop(event); }

 private:
  static constexpr std::size_t kMostTold = 16;

  void tell_once(const std::string& trouble) {
    if (std::ranges::find(told_, trouble) != told_.end()) return;
    if (told_.size() == kMostTold) told_.erase(told_.begin());
    told_.push_back(trouble);
    tell(trouble);
  }

  std::string running_;
  std::vector<std::string> told_;
  Ring<std::string, 32> events_;
};

}  // namespace azimuth
