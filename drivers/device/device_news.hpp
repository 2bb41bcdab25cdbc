#pragma once
#include <string>
#include <utility>

#include "base/ring.hpp"
#include "drivers/device/connection.hpp"

namespace azimuth {

/// What there is to tell of an odometer's device, for the log: every new trouble once, until the device runs again.
///
/// Thread contract: thread-bound. Nothing allocates while the device runs.
class DeviceNews {
 public:
  /// The device is called `name`, e.g. "/dev/ttyUSB0".
  explicit DeviceNews(std::string name) : name_(std::move(name)) {}

  /// The state becomes this one. A device that is only starting still has the trouble it had, unless there is another.
  void enter(Connection connection, const std::string& trouble, DeviceState& state) {
    const Connection before = std::exchange(state.connection, connection);
    if (connection == Connection::starting && trouble.empty()) return;
    if (state.trouble != trouble) state.trouble = trouble;
    if (connection == Connection::running) {
      if (before != connection) tell("odometry comes from " + name_);
      if (!told_trouble_.empty()) told_trouble_.clear();
    } else if (told_trouble_ != trouble) {
      told_trouble_ = trouble;
      tell(trouble);
    }
  }
  void tell(std::string event) { events_.push(std::move(event)); }
  /// The oldest sentence not taken yet.
  bool take(std::string& event) { return events_.pop(event); }

 private:
  std::string name_, told_trouble_;
  Ring<std::string, 32> events_;
};

}  // namespace azimuth
