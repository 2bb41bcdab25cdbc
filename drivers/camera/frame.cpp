#include "drivers/camera/frame.hpp"

#include <array>
#include <cassert>

namespace azimuth {

std::string_view name(PixelFormat pixels) {
  constexpr std::array<std::string_view, kPixelFormats> kNames{
      "gray8", "yuyv", "uyvy", "rgb8", "bgr8", "bayer_rggb8", "bayer_grbg8", "bayer_gbrg8", "bayer_bggr8", "mjpeg"};
  return kNames.at(static_cast<std::size_t>(pixels));
}

bool is_valid(const FrameFormat& format) {
  const auto is_side = [](int side_px) { return side_px >= 1 && side_px <= kMaxFrameSide_px; };
  if (!is_side(format.width_px) || !is_side(format.height_px)) return false;
  if (format.pixels == PixelFormat::mjpeg) return format.stride_bytes == 0;
  const bool in_pairs = format.pixels == PixelFormat::yuyv || format.pixels == PixelFormat::uyvy;
  if (in_pairs && format.width_px % 2 != 0) return false;
  const int row_bytes = format.width_px * bytes_per_pixel(format.pixels);
  return format.stride_bytes >= row_bytes && format.stride_bytes <= row_bytes + kMaxRowPadding;
}

void FramePool::give_back(unsigned slot) noexcept {
  assert(slot < kMaxSlots);
  // Release: the lease's last look at the pixels comes before the driver's next use of them.
  const std::uint32_t before = returned_.fetch_or(1U << slot, std::memory_order_acq_rel);
  if (before != 0 || !bell_) return;  // it rings already
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(bell_.get(), &one, sizeof one);
}

std::uint32_t FramePool::take_returned() noexcept {
  // Silenced before the slots are taken: one that comes back in between rings again. Without a bell the read fails.
  std::uint64_t rings = 0;
  [[maybe_unused]] const auto taken = ::read(bell_.get(), &rings, sizeof rings);
  return returned_.exchange(0, std::memory_order_acq_rel);
}

void Frame::swap(Frame& other) noexcept {
  std::swap(stamp, other.stamp);
  std::swap(sequence, other.sequence);
  std::swap(pool_, other.pool_);
  std::swap(slot_, other.slot_);
  std::swap(format_, other.format_);
  std::swap(bytes_, other.bytes_);
}

}  // namespace azimuth
