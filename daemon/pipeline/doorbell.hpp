#pragma once
#include <algorithm>
#include <array>
#include <atomic>
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

/// Wakes one sleeping thread. Each thread has one doorbell, and every wire that leads to the thread rings it, so the
/// thread can wait for all its wires at once. No ring is lost: a ring before wait() makes wait() return at once.
///
/// Thread contract: ring() may be called by any thread, does not block and is async-signal-safe; only the owning thread
/// calls wait().
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
    [[maybe_unused]] const auto written = ::write(fd_, &one, sizeof one);  // EAGAIN: it is already ringing
  }

  /// Sleeps until the doorbell rings or `at_most` has passed. Clears all rings so far.
  void wait(std::chrono::nanoseconds at_most) noexcept { wait_also(-1, 0, at_most); }

  /// Like wait(), but also returns when `descriptor` (-1: none) is ready for `events`, in the sense of poll(2).
  void wait_also(int descriptor, short events, std::chrono::nanoseconds at_most) noexcept {
    wait_also(std::array{pollfd{.fd = descriptor, .events = events, .revents = 0}}, at_most);
  }

  /// Like wait(), but also returns when one of several descriptors is ready.
  template <std::size_t Count>
  void wait_also(const std::array<pollfd, Count>& others, std::chrono::nanoseconds at_most) noexcept {
    if (at_most.count() < 0) at_most = {};
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(at_most);
    const timespec limit{.tv_sec = seconds.count(), .tv_nsec = (at_most - seconds).count()};
    std::array<pollfd, Count + 1> ready{pollfd{.fd = fd_, .events = POLLIN, .revents = 0}};
    std::copy(others.begin(), others.end(), ready.begin() + 1);
    if (::ppoll(ready.data(), ready.size(), &limit, nullptr) > 0 && ready[0].revents != 0) silence();
  }

  /// Clears all rings so far without sleeping.
  void silence() noexcept {
    std::uint64_t rings = 0;
    [[maybe_unused]] const auto taken = ::read(fd_, &rings, sizeof rings);
  }

  /// A descriptor for an event loop. It is readable while the doorbell rings.
  int descriptor() const noexcept { return fd_; }

 private:
  int fd_;
};

/// Tells one thread that another thread will send no more data. Once the reader has seen the mark, everything that the
/// writer put into its wires before set() is visible to the reader.
///
/// Thread contract: any thread may call set() and is_set().
class EndMark {
 public:
  /// The first set() rings `reader`.
  explicit EndMark(Doorbell& reader) : reader_(reader) {}

  void set() noexcept {
    if (!is_set_.exchange(true)) reader_.ring();
  }
  bool is_set() const noexcept { return is_set_.load(std::memory_order_acquire); }

 private:
  Doorbell& reader_;
  std::atomic<bool> is_set_{false};
};

}  // namespace azimuth
