#pragma once
// Internal to drivers/v4l2: the image buffers of the kernel's driver.

#include <algorithm>
#include <span>
#include <vector>

#include "drivers/camera/frame.hpp"
#include "drivers/v4l2/v4l2_handle.hpp"

namespace azimuth::v4l2 {

/// The mapped buffers of one stream. While any image of the stream is leased (Frame), all buffers stay mapped.
class Buffers final : public FramePool {
 public:
  Buffers(Calls& calls, UniqueFd bell) : FramePool(std::move(bell)), calls_(calls) { mapped_.reserve(kMaxSlots); }
  ~Buffers() override {
    for (const auto bytes : mapped_) calls_.unmap(bytes);
  }

  void add(std::span<std::byte> bytes) { mapped_.push_back(bytes); }
  unsigned count() const { return static_cast<unsigned>(mapped_.size()); }
  std::span<const std::byte> bytes(unsigned slot) const { return mapped_[slot]; }

 private:
  Calls& calls_;
  std::vector<std::span<std::byte>> mapped_;
};

/// A v4l2_buffer for either kind of capture. With planes, the numbers are in its single plane.
class BufferCall {
 public:
  explicit BufferCall(std::uint32_t buffer_type, std::uint32_t index = 0) {
    buffer_.type = buffer_type;
    buffer_.memory = V4L2_MEMORY_MMAP;
    buffer_.index = index;
    if (!has_planes()) return;
    buffer_.m.planes = &plane_;
    buffer_.length = 1;
  }
  BufferCall(const BufferCall&) = delete;
  BufferCall& operator=(const BufferCall&) = delete;

  int send(const Handle& handle, unsigned long request) { return handle.call(request, buffer_); }
  const v4l2_buffer& buffer() const { return buffer_; }
  std::uint32_t length() const { return has_planes() ? plane_.length : buffer_.length; }
  std::uint32_t offset() const { return has_planes() ? plane_.m.mem_offset : buffer_.m.offset; }
  /// Beginning and end of an image in its buffer.
  std::uint32_t begin() const { return has_planes() ? plane_.data_offset : 0; }
  std::uint32_t end() const { return has_planes() ? plane_.bytesused : buffer_.bytesused; }
  bool stamp_is_monotonic() const {
    return (buffer_.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  }

 private:
  bool has_planes() const { return buffer_.type == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE; }

  v4l2_buffer buffer_{};
  v4l2_plane plane_{};
};

/// The kernel's time of a frame, limited to the range of a stamp.
inline Stamp to_stamp(const timeval& time) {
  constexpr std::int64_t kLast_s = 1'000'000'000'000;  // beyond this, microseconds overflow
  const std::int64_t seconds = std::clamp<std::int64_t>(time.tv_sec, 0, kLast_s);
  return stamp_from_us(seconds * 1'000'000 + std::clamp<std::int64_t>(time.tv_usec, 0, 999'999));
}

}  // namespace azimuth::v4l2
