#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace azimuth::v4l2 {

/// The system calls a camera is reached by, and where its description stands, so that another can stand in for the
/// kernel. Errors are errno's numbers.
///
/// Thread contract: unmap() may be called by any thread, the rest as the caller's own contract has it. Must outlive
/// every stream opened through it and every frame of those.
class Calls {
 public:
  virtual ~Calls() = default;

  /// The descriptor, not blocking, or -errno.
  virtual int open(const std::string& path) = 0;
  virtual void close(int fd) = 0;
  /// 0 or errno; goes on when interrupted.
  virtual int ioctl(int fd, unsigned long request, void* argument) = 0;
  /// Empty with `error` set when it fails.
  virtual std::span<std::byte> map(int fd, std::size_t bytes, std::uint32_t offset, int& error) = 0;
  virtual void unmap(std::span<std::byte> bytes) = 0;
  /// What poll(2) says at once; 0: nothing.
  virtual short poll(int fd) = 0;
  virtual std::chrono::steady_clock::time_point now() = 0;

  virtual std::filesystem::path nodes() const { return "/dev"; }
  virtual std::filesystem::path classes() const { return "/sys/class/video4linux"; }
};

/// The kernel's own.
Calls& kernel_calls();

}  // namespace azimuth::v4l2
