#pragma once
#include <string>

namespace azimuth {

enum class Connection {
  away,      // there is no device, or it cannot be opened: tried from time to time
  starting,  // it is there, and nothing of use has come from it yet
  running,   // samples come
  silent,    // they came and have stopped
  closed     // for good, by close()
};

/// The word a user reads, e.g. "running".
const char* text(Connection connection);

/// How a device is. Of one that is away the rest of a driver's state is what was known last.
struct DeviceState {
  Connection connection = Connection::away;
  std::string trouble;  ///< why it is not running; empty: no trouble
};

/// Whether this is what the kernel says of a device that is there, but whose answers make no sense or do not come.
bool is_hung(int error_number);
/// And of one that is not there.
bool is_absent(int error_number);

}  // namespace azimuth
