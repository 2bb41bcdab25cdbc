#pragma once
// Frames for FakePerception, in buffers that know whether they are leased.

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <optional>
#include <sys/eventfd.h>

#include "drivers/camera/frame.hpp"

namespace azimuth::test {

inline constexpr FrameFormat kSmallFrame = packed_format(PixelFormat::gray8, 16, 2);

/// The few buffers of a camera driver. Thread contract: thread-bound, as a driver; leases may end on any thread.
class SmallPool {
 public:
  static constexpr unsigned kSlots = 4;

  /// A frame with `bearings` bearings, the first one at `azimuth` (see FakePerception); nullopt if every buffer is
  /// leased.
  std::optional<Frame> make(Stamp stamp, std::uint64_t sequence, std::uint8_t bearings, std::uint8_t azimuth) {
    leased_ &= ~pool_->take_returned();
    const unsigned slot = static_cast<unsigned>(std::countr_one(leased_));
    if (slot >= kSlots) return std::nullopt;
    leased_ |= 1U << slot;
    std::array<std::byte, 32>& pixels = pool_->pixels[slot];
    std::ranges::fill(pixels, std::byte{0});
    pixels[0] = std::byte{bearings};
    for (std::size_t k = 1; k <= bearings; ++k) pixels[k] = static_cast<std::byte>(azimuth + k - 1);
    Frame frame(pool_, slot, kSmallFrame, pixels);
    frame.stamp = stamp;
    frame.sequence = sequence;
    return frame;
  }
  /// Number of buffers that are still leased.
  int leased() {
    leased_ &= ~pool_->take_returned();
    return std::popcount(leased_);
  }
  int descriptor() const { return pool_->descriptor(); }

 private:
  struct Pool : FramePool {
    Pool() : FramePool(UniqueFd(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC))) {}
    std::array<std::array<std::byte, 32>, kSlots> pixels{};
  };
  std::shared_ptr<Pool> pool_ = std::make_shared<Pool>();
  std::uint32_t leased_ = 0;
};

}  // namespace azimuth::test
