#pragma once
// Internal to drivers/iidc.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "drivers/camera/frame.hpp"

namespace azimuth::iidc {

/// The driver's own buffers for images. Thread contract: as for FramePool.
class IidcFrames : public FramePool {
 public:
  /// Enough for the images that a driver holds unread and those on their way to perception.
  static constexpr unsigned kSlots = 10;

  explicit IidcFrames(const FrameFormat& format)
      : FramePool(UniqueFd{}), bytes_(format.bytes()), memory_(kSlots * bytes_) {}

  /// A buffer that is not leased. It stays free until lease().
  std::optional<unsigned> free_slot() {
    free_ |= take_returned();
    return free_ == 0 ? std::nullopt : std::optional(static_cast<unsigned>(std::countr_zero(free_)));
  }
  std::span<std::byte> buffer(unsigned slot) { return std::span(memory_).subspan(slot * bytes_, bytes_); }

  /// `self` owns this object.
  static Frame lease(const std::shared_ptr<IidcFrames>& self, unsigned slot, const FrameFormat& format) {
    self->free_ &= ~(1U << slot);
    return {self, slot, format, self->buffer(slot)};
  }

 private:
  std::size_t bytes_;
  std::vector<std::byte> memory_;
  std::uint32_t free_ = (1U << kSlots) - 1;
};

}  // namespace azimuth::iidc
