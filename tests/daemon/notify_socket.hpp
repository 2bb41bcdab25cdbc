#pragma once
// The service manager's end of the sd_notify protocol.

#include <chrono>
#include <cstring>
#include <filesystem>
#include <poll.h>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace azimuth::test {

/// A datagram socket in a folder, as systemd provides it.
class NotifySocket {
 public:
  explicit NotifySocket(const std::filesystem::path& folder)
      : path_(folder / "notify"), fd_(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path_.c_str(), sizeof address.sun_path - 1);
    if (fd_ < 0 || bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
      throw std::runtime_error("cannot bind " + path_.string());
    }
  }
  ~NotifySocket() { close(fd_); }
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  std::string variable() const { return "NOTIFY_SOCKET=" + path_.string(); }

  /// The next message; empty if none comes within `limit`.
  std::string receive(std::chrono::milliseconds limit) const {
    pollfd ready{.fd = fd_, .events = POLLIN, .revents = 0};
    if (poll(&ready, 1, static_cast<int>(limit.count())) != 1) return {};
    char buffer[4096];
    const ssize_t size = recv(fd_, buffer, sizeof buffer, 0);
    return size > 0 ? std::string(buffer, static_cast<std::size_t>(size)) : std::string();
  }

  /// Whether a message that contains `part` comes within `limit`. Other messages are dropped.
  bool receives(const std::string& part, std::chrono::milliseconds limit) const {
    const auto end = std::chrono::steady_clock::now() + limit;
    for (;;) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
      if (left.count() <= 0) return false;
      if (receive(left).find(part) != std::string::npos) return true;
    }
  }

  /// Sends the socket a message of the test's own. Returns false if the socket is full.
  bool takes(const std::string& message) const {
    const int sender = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path_.c_str(), sizeof address.sun_path - 1);
    const ssize_t sent =
        sendto(sender, message.data(), message.size(), 0, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    close(sender);
    return sent >= 0;
  }

  /// Drops all messages that have come so far.
  void drop_all() const {
    while (!receive(std::chrono::milliseconds(0)).empty()) {
    }
  }

 private:
  std::filesystem::path path_;
  int fd_;
};

}  // namespace azimuth::test
