#include "daemon/supervise/service_manager.hpp"

#include <spdlog/spdlog.h>
#include <system_error>
#include <systemd/sd-daemon.h>

namespace azimuth {

void ServiceManager::ready(const std::string& status) { send("READY=1\nSTATUS=" + status); }
void ServiceManager::status(const std::string& status) { send("STATUS=" + status); }
void ServiceManager::stopping() { send("STOPPING=1\nSTATUS=stopping"); }
void ServiceManager::alive() { send("WATCHDOG=1"); }

std::optional<std::chrono::microseconds> ServiceManager::watchdog_interval() {
  std::uint64_t interval_us = 0;
  if (sd_watchdog_enabled(0, &interval_us) <= 0) return std::nullopt;
  return std::chrono::microseconds(interval_us);
}

void ServiceManager::send(const std::string& state) {
  const int result = sd_notify(0, state.c_str());
  const bool fails = result < 0;
  if (fails && !failing_) spdlog::warn("service manager: cannot notify: {}", std::generic_category().message(-result));
  failing_ = fails;
}

}  // namespace azimuth
