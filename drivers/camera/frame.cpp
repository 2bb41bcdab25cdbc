#include "drivers/camera/frame.hpp"

#include <cassert>

namespace azimuth {

void FramePool::give_back(unsigned slot) noexcept {
  assert(slot < kMaxSlots);
  // Release order: the holder's last read of the pixels precedes the driver's next use of them.
  const std::uint32_t before = returned_.fetch_or(1U << slot, std::memory_order_acq_rel);
  if (before != 0 || !bell_) return;  // the bell already rings
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(bell_.get(), &one, sizeof one);
}

std::uint32_t FramePool::take_returned() noexcept {
  // The bell is cleared before the slots are taken, so a slot that comes back in between rings it again. Without a bell
  // the read fails, which does no harm.
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
