#pragma once
#include <chrono>
#include <optional>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>

#include "base/unique_fd.hpp"

namespace azimuth {

/// Sends notifications to systemd through NOTIFY_SOCKET. Without that variable every call does nothing.
///
/// No call blocks. (sd_notify(3) would block.) When the manager does not read, statuses and watchdog pings are lost,
/// while ready(), reloading() and stopping() are sent again with the next call.
///
/// Thread contract: thread-bound; constructed before the first thread starts.
class ServiceManager {
 public:
  ServiceManager();

  void ready(const std::string& status);
  void reloading();
  void status(const std::string& status);
  void stopping();
  void alive();    ///< feeds the watchdog
  void give_up();  ///< tells the manager to act as if the watchdog had expired

  /// Longest allowed time between two calls of alive(); none: the manager has no watchdog.
  static std::optional<std::chrono::microseconds> watchdog_interval();

 private:
  void send_surely(const std::string& state);
  void send(const std::string& state);
  int try_to_send(const std::string& state);
  void note(int error);

  UniqueFd socket_;
  sockaddr_un address_{};
  socklen_t address_size_ = 0;
  std::string unsent_;  ///< state that still has to be sent
  bool failing_ = false;
};

}  // namespace azimuth
