#pragma once
#include <cerrno>
#include <unistd.h>

#include "drivers/io/event_codec.hpp"

namespace azimuth {

/// Writes all of `bytes`; 0 or the errno that stopped it.
inline int write_all(int fd, Bytes bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

}  // namespace azimuth
