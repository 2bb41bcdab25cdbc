#pragma once
#include <string>

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

}  // namespace azimuth
