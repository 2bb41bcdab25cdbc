#include "drivers/v4l2/v4l2_calls.hpp"

#include <cerrno>
#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace azimuth::v4l2 {
namespace {

class KernelCalls final : public Calls {
 public:
  int open(const std::string& path) override {
    const int fd = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    return fd < 0 ? -errno : fd;
  }
  void close(int fd) override { ::close(fd); }
  int ioctl(int fd, unsigned long request, void* argument) override {
    while (::ioctl(fd, request, argument) < 0)
      if (errno != EINTR) return errno;
    return 0;
  }
  /// The mapping is writable because some drivers refuse a read-only one. Nothing is written to it.
  std::span<std::byte> map(int fd, std::size_t bytes, std::uint32_t offset, int& error) override {
    void* const start = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, fd, static_cast<off_t>(offset));
    error = start == MAP_FAILED ? errno : 0;
    return error == 0 ? std::span(static_cast<std::byte*>(start), bytes) : std::span<std::byte>{};
  }
  void unmap(std::span<std::byte> bytes) override { ::munmap(bytes.data(), bytes.size()); }
  short poll(int fd) override {
    pollfd ready{.fd = fd, .events = POLLIN, .revents = 0};
    return ::poll(&ready, 1, 0) > 0 ? ready.revents : short{0};
  }
  std::chrono::steady_clock::time_point now() override { return std::chrono::steady_clock::now(); }
};

}  // namespace

Calls& kernel_calls() {
  static KernelCalls calls;
  return calls;
}

}  // namespace azimuth::v4l2
