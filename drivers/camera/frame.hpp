#pragma once
// Images as cameras hand them out: leases on buffers that belong to a driver.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "drivers/io/unique_fd.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// How a pixel's value stands in memory, 8 bits a sample. Bayer formats are named by the first two pixels of the first
/// two rows. The numbers travel between processes: never change one.
enum class PixelFormat : std::uint8_t {
  gray8 = 0,
  yuyv = 1,  ///< 4:2:2, two pixels in Y0 U Y1 V
  uyvy = 2,  ///< 4:2:2, two pixels in U Y0 V Y1
  rgb8 = 3,
  bgr8 = 4,
  bayer_rggb8 = 5,
  bayer_grbg8 = 6,
  bayer_gbrg8 = 7,
  bayer_bggr8 = 8,
  mjpeg = 9,  ///< each frame is one JPEG image
};
inline constexpr int kPixelFormats = 10;

/// The enumerator's name.
std::string_view name(PixelFormat pixels);

/// Bytes of one pixel; 0 for mjpeg, which has none of fixed size.
constexpr int bytes_per_pixel(PixelFormat pixels) {
  switch (pixels) {
    case PixelFormat::mjpeg:
      return 0;
    case PixelFormat::yuyv:
    case PixelFormat::uyvy:
      return 2;
    case PixelFormat::rgb8:
    case PixelFormat::bgr8:
      return 3;
    default:
      return 1;
  }
}

struct FrameFormat {
  PixelFormat pixels = PixelFormat::gray8;
  int width_px = 0;
  int height_px = 0;
  int stride_bytes = 0;  ///< from row to row; 0 for mjpeg
  friend bool operator==(const FrameFormat&, const FrameFormat&) = default;

  /// Of a whole uncompressed frame.
  std::size_t bytes() const { return static_cast<std::size_t>(stride_bytes) * static_cast<std::size_t>(height_px); }
};

/// Rows without padding.
constexpr FrameFormat packed_format(PixelFormat pixels, int width_px, int height_px) {
  return {pixels, width_px, height_px, width_px * bytes_per_pixel(pixels)};
}

/// Whether memory can be laid out like that: sides from 1 to kMaxFrameSide_px, even width for the 4:2:2 formats, rows
/// that do not overlap and are padded by at most kMaxRowPadding bytes.
bool is_valid(const FrameFormat& format);
inline constexpr int kMaxFrameSide_px = 16384;
inline constexpr int kMaxRowPadding = 4096;

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
