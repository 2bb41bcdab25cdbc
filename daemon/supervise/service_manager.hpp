#pragma once
#include <chrono>
#include <optional>
#include <string>

namespace azimuth {

/// What systemd is told through NOTIFY_SOCKET. Without one every call does nothing.
///
/// Thread contract: thread-bound.
class ServiceManager {
 public:
  void ready(const std::string& status);
  void status(const std::string& status);
  void stopping();
  void alive();  ///< feeds the watchdog

  /// How often the watchdog must be fed at least, if the manager has one.
  static std::optional<std::chrono::microseconds> watchdog_interval();

 private:
  void send(const std::string& state);
  bool failing_ = false;
};

}  // namespace azimuth
