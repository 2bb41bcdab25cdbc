#pragma once
// Camera images as leases on buffers that belong to a driver.

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

/// The buffers of a driver, and the path on which leased buffers come back. It lives as long as the driver or any
/// lease.
///
/// Thread contract: any thread may call give_back(); all other functions belong to the driver's thread.
class FramePool {
 public:
  static constexpr unsigned kMaxSlots = 32;

  /// `bell` is an eventfd that becomes readable when a buffer comes back; it may be empty for a driver that only polls.
  explicit FramePool(UniqueFd bell) : bell_(std::move(bell)) {}
  virtual ~FramePool() = default;
  FramePool(const FramePool&) = delete;
  FramePool& operator=(const FramePool&) = delete;

  void give_back(unsigned slot) noexcept;
  /// The slots given back since the last call, one bit for each. Clears the bell.
  std::uint32_t take_returned() noexcept;
  int descriptor() const { return bell_.get(); }

 private:
  UniqueFd bell_;
  std::atomic<std::uint32_t> returned_{0};
};

/// A leased image: the driver cannot use its buffer until this object is destroyed. Keep it only briefly, because a
/// driver loses images while all its buffers are leased.
///
/// The pixels may change during reading if the process that fills the buffers misbehaves. Reading them is always safe,
/// but code must not rely on reading the same value twice.
///
/// Thread contract: thread-bound; may be destroyed on any thread, before or after the driver.
class Frame {
 public:
  Frame() = default;
  /// `bytes` must stay valid as long as `pool`. With a null pool, the caller keeps the bytes alive longer than the
  /// frame.
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

  /// True: there is an image.
  explicit operator bool() const { return !bytes_.empty(); }
  const FrameFormat& format() const { return format_; }
  /// The whole image: format().bytes() bytes, or a JPEG file.
  std::span<const std::byte> bytes() const { return bytes_; }
  ImageView view() const { return {format_, bytes_}; }

  Stamp stamp{};               ///< middle of the exposure if the source knows it
  std::uint64_t sequence = 0;  ///< counts images at their source; a gap means that images were lost

  void swap(Frame& other) noexcept;
  friend void swap(Frame& a, Frame& b) noexcept { a.swap(b); }

 private:
  std::shared_ptr<FramePool> pool_;
  unsigned slot_ = 0;
  FrameFormat format_{};
  std::span<const std::byte> bytes_;
};

}  // namespace azimuth
