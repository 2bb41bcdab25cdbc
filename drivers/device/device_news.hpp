#pragma once
#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "base/ring.hpp"
#include "drivers/device/connection.hpp"

namespace azimuth {

/// The messages about a device for the log. Each new trouble is reported once until the device runs again, even when
/// several troubles alternate.
///
/// Thread contract: thread-bound. Nothing allocates while the device runs.
class DeviceNews {
 public:
  /// `running` is the message for a device that starts to run, e.g. "odometry comes from /dev/ttyUSB0".
  explicit DeviceNews(std::string running = {}) : running_(std::move(running)) {}
  void call_running(std::string running) { running_ = std::move(running); }

  /// Changes `state`. A device that is starting keeps its previous trouble, unless there is another one.
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
  /// Takes the oldest message.
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
