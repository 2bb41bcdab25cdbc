#pragma once
// Images as cameras hand them out: leases on buffers that belong to a driver.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "base/unique_fd.hpp"
#include "slam/sample/image.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// The buffers of a driver, and the way in which leased ones come back. Lives as long as the driver or any lease does.
///
/// Thread contract: give_back() may be called by any thread; the rest belongs to the driver's.
class FramePool {
 public:
  static constexpr unsigned kMaxSlots = 32;

  /// `bell` is an eventfd that becomes readable when a buffer came back, or nothing for a driver that only polls.
  explicit FramePool(UniqueFd bell) : bell_(std::move(bell)) {}
  virtual ~FramePool() = default;
  FramePool(const FramePool&) = delete;
  FramePool& operator=(const FramePool&) = delete;

  void give_back(unsigned slot) noexcept;
  /// The slots given back since the last call, one bit each; silences the bell.
  std::uint32_t take_returned() noexcept;
  int descriptor() const { return bell_.get(); }

 private:
  UniqueFd bell_;
  std::atomic<std::uint32_t> returned_{0};
};

/// One image, leased: the driver cannot use its buffer until this object dies. Holders should be quick: a driver whose
/// buffers are all leased loses images.
///
/// Pixels may change under a reader's hands if the process that fills the buffers misbehaves. Reading them is always
/// safe, but nothing may be concluded twice from one pixel.
///
/// Thread contract: thread-bound; may die on any thread, whether the driver still lives or not.
class Frame {
 public:
  Frame() = default;
  /// `bytes` must stay valid as long as `pool`. A null pool: the bytes outlive the frame by themselves.
  Frame(std::shared_ptr<FramePool> pool, unsigned slot, const FrameFormat& format, std::span<const std::byte> bytes)
      : pool_(std::move(pool)), slot_(slot), format_(format), bytes_(bytes) {}
  Frame(Frame&& other) noexcept { swap(other); }
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;
  Frame& operator=(Frame&& other) noexcept {
    Frame(std::move(other)).swap(*this);
    return *this;
  }
  ~Frame() {
    if (pool_) pool_->give_back(slot_);
  }

  /// Whether there is an image.
  explicit operator bool() const { return !bytes_.empty(); }
  const FrameFormat& format() const { return format_; }
  /// The whole image: format().bytes() of them, or a JPEG file.
  std::span<const std::byte> bytes() const { return bytes_; }
  ImageView view() const { return {format_, bytes_}; }

  Stamp stamp{};               ///< middle of the exposure if the source knows it
  std::uint64_t sequence = 0;  ///< counts images at their source; a gap means images were lost

  void swap(Frame& other) noexcept;
  friend void swap(Frame& a, Frame& b) noexcept { a.swap(b); }

 private:
  std::shared_ptr<FramePool> pool_;
  unsigned slot_ = 0;
  FrameFormat format_{};
  std::span<const std::byte> bytes_;
};

}  // namespace azimuth
