#pragma once
#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "base/ring.hpp"

namespace azimuth {

enum class Connection {
  away,      // there is no device, or it cannot be opened; it is tried from time to time
  starting,  // the device is there, and nothing useful has come from it yet
  running,   // samples arrive
  silent,    // samples have stopped arriving
  closed     // closed for good, by close()
};

/// The word shown to users, e.g. "running".
const char* text(Connection connection);

/// The state of a device. While it is away, the other members of a driver's state keep their last values.
struct DeviceState {
  Connection connection = Connection::away;
  std::string trouble;  ///< why it is not running; empty: no trouble
};

/// True: the kernel returns this error for a device that is present, but gives no answer or a wrong one.
bool is_hung(int error_number);
/// True: the kernel returns this error for a device that is not present.
bool is_absent(int error_number);

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
