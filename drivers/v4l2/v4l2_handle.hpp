#pragma once
// Internal to drivers/v4l2.

#include <cstdint>
#include <linux/videodev2.h>
#include <string>
#include <utility>

#include "drivers/camera/image_stream.hpp"
#include "drivers/v4l2/v4l2_calls.hpp"

namespace azimuth::v4l2 {

/// An open node, and the words for what it has against us. Closes it in the end.
///
/// Thread contract: thread-bound.
class Handle {
 public:
  Handle(Calls& calls, std::string device, int fd) : calls_(&calls), device_(std::move(device)), fd_(fd) {}
  Handle(Handle&& other) noexcept
      : calls_(other.calls_), device_(std::move(other.device_)), fd_(std::exchange(other.fd_, -1)) {}
  Handle(const Handle&) = delete;
  Handle& operator=(Handle&&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (fd_ >= 0) calls_->close(fd_);
  }

  Calls& calls() const { return *calls_; }
  const std::string& device() const { return device_; }
  int descriptor() const { return fd_; }

  /// 0 or errno.
  template <class Argument>
  int call(unsigned long request, Argument& argument) const {
    return calls_->ioctl(fd_, request, &argument);
  }

  /// "/dev/video0: VIDIOC_S_FMT: Device or resource busy"; without errno as it is.
  CameraTrouble trouble(std::string_view what, int error = 0) const;

 private:
  Calls* calls_;
  std::string device_;
  int fd_;
};

/// What a node can do, as QUERYCAP says.
struct Abilities {
  std::string card;
  std::uint32_t buffer_type = 0;  ///< of images; 0: it gives none, or not by streaming
  bool has_planes() const { return buffer_type == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE; }
};

/// errno, or 0 and `abilities`.
int ask_abilities(const Handle& handle, Abilities& abilities);

/// "No such device", for errno.
std::string error_text(int error);

}  // namespace azimuth::v4l2
