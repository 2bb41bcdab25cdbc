#pragma once
// Internal to drivers/v4l2.

#include <cstdint>
#include <linux/videodev2.h>
#include <string>
#include <utility>

#include "drivers/camera/image_stream.hpp"
#include "drivers/v4l2/v4l2_calls.hpp"

namespace azimuth::v4l2 {

/// An open node, which creates the texts of its errors and closes the node in the end.
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

  /// Returns 0 or errno.
  template <class Argument>
  int call(unsigned long request, Argument& argument) const {
    return calls_->ioctl(fd_, request, &argument);
  }

  /// "/dev/video0: VIDIOC_S_FMT: Device or resource busy"; without an errno, only the first two parts.
  CameraTrouble trouble(std::string_view what, int error = 0) const;

 private:
  Calls* calls_;
  std::string device_;
  int fd_;
};

/// The capabilities of a node according to VIDIOC_QUERYCAP.
struct Abilities {
  std::string card;
  std::uint32_t buffer_type = 0;  ///< type for images; 0: the node provides none, or not by streaming
  bool has_planes() const { return buffer_type == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE; }
};

/// Returns errno, or 0 with `abilities` filled in.
int ask_abilities(const Handle& handle, Abilities& abilities);

/// The text of an errno, e.g. "No such device".
std::string error_text(int error);

}  // namespace azimuth::v4l2
