#include "drivers/device/connection.hpp"

#include <cerrno>

namespace azimuth {

const char* text(Connection connection) {
  switch (connection) {
    case Connection::away:
      return "away";
    case Connection::starting:
      return "starting";
    case Connection::running:
      return "running";
    case Connection::silent:
      return "silent";
    case Connection::closed:
      return "closed";
  }
  return "";
}

bool is_hung(int error_number) {
  return error_number == EIO || error_number == ETIMEDOUT || error_number == EPROTO || error_number == EPIPE ||
         error_number == EILSEQ;
}

bool is_absent(int error_number) { return error_number == ENOENT || error_number == ENODEV || error_number == ENXIO; }

}  // namespace azimuth
