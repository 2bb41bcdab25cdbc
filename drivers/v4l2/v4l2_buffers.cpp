#include "drivers/v4l2/v4l2_buffers.hpp"

#include <algorithm>

namespace azimuth::v4l2 {

BufferCall::BufferCall(std::uint32_t buffer_type, std::uint32_t index) {
  buffer_.type = buffer_type;
  buffer_.memory = V4L2_MEMORY_MMAP;
  buffer_.index = index;
  if (!has_planes()) return;
  buffer_.m.planes = &plane_;
  buffer_.length = 1;
}

Stamp to_stamp(const timeval& time) {
  constexpr std::int64_t kLast_s = 1'000'000'000'000;  // beyond this, microseconds overflow
  const std::int64_t seconds = std::clamp<std::int64_t>(time.tv_sec, 0, kLast_s);
  return stamp_from_us(seconds * 1'000'000 + std::clamp<std::int64_t>(time.tv_usec, 0, 999'999));
}

}  // namespace azimuth::v4l2
