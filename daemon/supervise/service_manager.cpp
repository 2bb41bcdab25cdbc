#include "daemon/supervise/service_manager.hpp"

#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <system_error>
#include <systemd/sd-daemon.h>

#include "base/clocks.hpp"

namespace azimuth {

ServiceManager::ServiceManager() {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): before the first thread starts
  const char* const path = std::getenv("NOTIFY_SOCKET");
  if (!path || (path[0] != '/' && path[0] != '@')) return;
  const std::size_t length = std::strlen(path);
  if (length >= sizeof address_.sun_path) {
    note(ENAMETOOLONG);
    return;
  }
  address_.sun_family = AF_UNIX;
  std::memcpy(address_.sun_path, path, length);
  if (path[0] == '@') address_.sun_path[0] = '\0';  // an abstract address, whose name has exactly this length
  address_size_ = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + length);
  socket_ = UniqueFd(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!socket_) note(errno);
}

void ServiceManager::ready(const std::string& status) { send_surely("READY=1\nSTATUS=" + status); }
void ServiceManager::reloading() {
  send_surely(fmt::format("RELOADING=1\nMONOTONIC_USEC={}\nSTATUS=reading the configuration anew",
                          now_on(CLOCK_MONOTONIC).count()));
}
void ServiceManager::status(const std::string& status) { send("STATUS=" + status); }
void ServiceManager::stopping() { send_surely("STOPPING=1\nSTATUS=stopping"); }
void ServiceManager::alive() { send("WATCHDOG=1"); }
void ServiceManager::give_up() { send_surely("WATCHDOG=trigger"); }

std::optional<std::chrono::microseconds> ServiceManager::watchdog_interval() {
  std::uint64_t interval_us = 0;
  if (sd_watchdog_enabled(0, &interval_us) <= 0) return std::nullopt;
  return std::chrono::microseconds(interval_us);
}

/// Only the newest of these states has to arrive, so it replaces an earlier one.
void ServiceManager::send_surely(const std::string& state) {
  if (!socket_) return;
  const int error = try_to_send(state);
  unsent_ = error == EAGAIN ? state : std::string();
  note(error);
}

void ServiceManager::send(const std::string& state) {
  if (!socket_) return;
  if (!unsent_.empty()) send_surely(std::string(unsent_));
  if (unsent_.empty()) note(try_to_send(state));
}

/// Returns 0 or errno.
int ServiceManager::try_to_send(const std::string& state) {
  const ssize_t sent = ::sendto(socket_.get(), state.data(), state.size(), MSG_NOSIGNAL | MSG_DONTWAIT,
                                reinterpret_cast<const sockaddr*>(&address_), address_size_);
  return sent < 0 ? errno : 0;
}

void ServiceManager::note(int error) {
  const bool fails = error != 0;
  if (fails && !failing_) spdlog::warn("service manager: cannot notify: {}", std::generic_category().message(error));
  failing_ = fails;
}

}  // namespace azimuth
