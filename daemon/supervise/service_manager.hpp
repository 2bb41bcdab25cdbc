#pragma once
#include <chrono>
#include <optional>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>

#include "base/unique_fd.hpp"

namespace azimuth {

/// What systemd is told through NOTIFY_SOCKET. Without one every call does nothing.
///
/// No call waits: a manager that does not read misses statuses and watchdog pings, while ready(), reloading() and
/// stopping() are tried again with the next call. (sd_notify(3) would wait.)
///
/// Thread contract: thread-bound; made before the first thread starts.
class ServiceManager {
 public:
  ServiceManager();

  void ready(const std::string& status);
  void reloading();
  void status(const std::string& status);
  void stopping();
  void alive();    ///< feeds the watchdog
  void give_up();  ///< as if the watchdog had not been fed for too long

  /// How often the watchdog must be fed at least, if the manager has one.
  static std::optional<std::chrono::microseconds> watchdog_interval();

 private:
  void send_surely(const std::string& state);
  void send(const std::string& state);
  int try_to_send(const std::string& state);
  void note(int error);

  UniqueFd socket_;
  sockaddr_un address_{};
  socklen_t address_size_ = 0;
  std::string unsent_;  ///< what the manager must still be told
  bool failing_ = false;
};

}  // namespace azimuth
