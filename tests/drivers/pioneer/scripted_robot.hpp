#pragma once
// A controller at the other end of a pseudo terminal or a TCP connection, polled by the test's own thread.

#include <array>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <netinet/in.h>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <unistd.h>

#include "base/unique_fd.hpp"
#include "tests/drivers/pioneer/fake_controller.hpp"

namespace azimuth::pioneer::test {

inline int checked(int returned, const char* what) {
  if (returned < 0) throw std::runtime_error(what);
  return returned;
}

/// A controller on a pseudo terminal, which has no baud rate.
class PtyRobot {
 public:
  explicit PtyRobot(FakeController& controller) : controller_(controller) {
    master_ = UniqueFd(checked(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC), "posix_openpt"));
    checked(::grantpt(master_.get()), "grantpt");
    checked(::unlockpt(master_.get()), "unlockpt");
    std::array<char, 64> name{};
    checked(-::ptsname_r(master_.get(), name.data(), name.size()), "ptsname_r");
    device_ = name.data();
  }
  const std::string& device() const { return device_; }

  /// Answers the received bytes.
  void serve() {
    std::array<std::uint8_t, 256> bytes{};
    ssize_t size = 0;
    while ((size = ::read(master_.get(), bytes.data(), bytes.size())) > 0)
      send(controller_.receive(ByteView(bytes).first(static_cast<std::size_t>(size)), 0));
  }
  void send(ByteView bytes) {
    while (!bytes.empty()) {
      const ssize_t size = ::write(master_.get(), bytes.data(), bytes.size());
      if (size <= 0) return;
      bytes = bytes.subspan(static_cast<std::size_t>(size));
    }
  }

 private:
  FakeController& controller_;
  UniqueFd master_;
  std::string device_;
};

/// A controller behind a listening socket on the loopback interface.
class TcpRobot {
 public:
  explicit TcpRobot(FakeController& controller) : controller_(controller) {
    listener_ = UniqueFd(checked(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0), "socket"));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    checked(::bind(listener_.get(), reinterpret_cast<sockaddr*>(&address), size), "bind");
    checked(::listen(listener_.get(), 1), "listen");
    checked(::getsockname(listener_.get(), reinterpret_cast<sockaddr*>(&address), &size), "getsockname");
    device_ = "tcp:localhost:" + std::to_string(ntohs(address.sin_port));
  }
  const std::string& device() const { return device_; }

  void serve() {
    if (!peer_) peer_ = UniqueFd(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    std::array<std::uint8_t, 256> bytes{};
    ssize_t size = 0;
    while (peer_ && (size = ::read(peer_.get(), bytes.data(), bytes.size())) > 0)
      send(controller_.receive(ByteView(bytes).first(static_cast<std::size_t>(size)), 0));
  }
  void send(ByteView bytes) {
    if (peer_) [[maybe_unused]]
      const auto sent = ::send(peer_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }
  void hang_up() { peer_ = UniqueFd(); }

 private:
  FakeController& controller_;
  UniqueFd listener_, peer_;
  std::string device_;
};

}  // namespace azimuth::pioneer::test
