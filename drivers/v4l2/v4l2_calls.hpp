#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace azimuth::v4l2 {

/// The system calls and file system paths for a camera, as an interface, so that tests can replace the kernel. Errors
/// are errno values.
///
/// Thread contract: any thread may call unmap(); all other functions follow the caller's contract. The object must
/// outlive every stream opened through it, and all frames of those streams.
class Calls {
 public:
  virtual ~Calls() = default;

  /// The descriptor, non-blocking, or -errno.
  virtual int open(const std::string& path) = 0;
  virtual void close(int fd) = 0;
  /// 0 or errno; continues after an interruption.
  virtual int ioctl(int fd, unsigned long request, void* argument) = 0;
  /// Maps a buffer into memory. Empty on failure, with the cause in `error`.
  virtual std::span<std::byte> map(int fd, std::size_t bytes, std::uint32_t offset, int& error) = 0;
  virtual void unmap(std::span<std::byte> bytes) = 0;
  /// The result of poll(2) without waiting; 0: no event.
  virtual short poll(int fd) = 0;
  virtual std::chrono::steady_clock::time_point now() = 0;

  virtual std::filesystem::path nodes() const { return "/dev"; }
  virtual std::filesystem::path classes() const { return "/sys/class/video4linux"; }
};

/// The calls of the real kernel.
Calls& kernel_calls();

}  // namespace azimuth::v4l2
