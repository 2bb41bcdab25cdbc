#pragma once
#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <poll.h>
#include <sys/eventfd.h>
#include <system_error>
#include <unistd.h>

namespace azimuth {

/// Wakes one sleeping thread. Every wire into a thread rings that thread's only doorbell, so it can wait for all of
/// them at once without losing a ring: one that comes before wait() ends it at once.
///
/// Thread contract: ring() may be called by any thread, does not block and is async-signal-safe; wait() is for the
/// owner only.
class Doorbell {
 public:
  /// Throws std::system_error when the process is out of descriptors.
  Doorbell() : fd_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
    if (fd_ < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
  }
  ~Doorbell() { ::close(fd_); }
  Doorbell(const Doorbell&) = delete;
  Doorbell& operator=(const Doorbell&) = delete;

  void ring() noexcept {
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(fd_, &one, sizeof one);  // EAGAIN: it is ringing already
  }

  /// Sleeps until rung or until `at_most` has passed; takes all rings so far.
  void wait(std::chrono::nanoseconds at_most) noexcept { wait_also(-1, 0, at_most); }

  /// Likewise, and ends too when `descriptor` (-1: none) is ready for `events`, as poll(2) has it.
  void wait_also(int descriptor, short events, std::chrono::nanoseconds at_most) noexcept {
    wait_also(std::array{pollfd{.fd = descriptor, .events = events, .revents = 0}}, at_most);
  }

  /// Likewise with several descriptors.
  template <std::size_t Count>
  void wait_also(const std::array<pollfd, Count>& others, std::chrono::nanoseconds at_most) noexcept {
    if (at_most.count() < 0) at_most = {};
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(at_most);
    const timespec limit{.tv_sec = seconds.count(), .tv_nsec = (at_most - seconds).count()};
    std::array<pollfd, Count + 1> ready{pollfd{.fd = fd_, .events = POLLIN, .revents = 0}};
    std::copy(others.begin(), others.end(), ready.begin() + 1);
    if (::ppoll(ready.data(), ready.size(), &limit, nullptr) > 0 && ready[0].revents != 0) silence();
  }

  /// Takes all rings so far without sleeping.
  void silence() noexcept {
    std::uint64_t rings = 0;
    [[maybe_unused]] const auto taken = ::read(fd_, &rings, sizeof rings);
  }

  /// For an event loop: readable while it rings.
  int descriptor() const noexcept { return fd_; }

 private:
  int fd_;
};

}  // namespace azimuth
