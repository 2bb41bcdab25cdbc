#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "slam/camera/camera_rig.hpp"
#include "slam/camera/image_mask.hpp"
#include "slam/perception/image/row_seams.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// Recognises rows that belong to an earlier image: a camera's buffer still holds them if only a part of it was
/// rewritten.
///
/// Sensor noise makes every row differ from the same row of other images. An image is torn if its rows below some row
/// (or above it) equal those of an earlier image to the last bit while all other rows differ. Rows without noise are
/// ignored, as are rows that several earlier images share: both are synthetic. Most rows must carry noise for a
/// verdict.
///
/// Thread contract: thread-bound. Nothing allocates after construction.
class RowHistory {
 public:
  /// Digest of a row's pixels; kNothing for a row without noise.
  using Digest = std::uint64_t;
  static constexpr Digest kNothing = 0;

  RowHistory() = default;
  explicit RowHistory(std::size_t rows);

  std::vector<Digest>& newest() { return images_[newest_]; }  ///< To be filled from top to bottom

  /// Adds the newest image to the history. Returns whether it has rows of an earlier image.
  bool add();

 private:
  static constexpr std::size_t kImages = 8;  // Cameras typically have about four buffers
  using Rows = std::vector<Digest>;

  bool has_rows_of(std::size_t before) const;
  bool is_of_one_instant(std::size_t before, std::size_t row) const;
  const Rows& image(std::size_t before) const { return images_[(newest_ + kImages - before) % kImages]; }

  std::array<Rows, kImages> images_;
  std::size_t newest_ = 0, held_ = 0;
};

/// Evenly spread samples of the visible part of an image, each a few adjacent pixels in one row. They suffice to judge
/// an image as a whole.
///
/// Thread contract: reentrant.
class SampleLattice {
 public:
  static constexpr int kSampleWidth_px = 4;   ///< Averaging halves the standard deviation of the sensor's noise
  static constexpr int kMostSamples = 16384;  ///< Approximate

  struct Sample {
    int u = 0;              ///< The sample's first pixel
    std::size_t left = 0;   ///< Index of the sample to the left; its own index if there is none.
    std::size_t above = 0;  ///< Index of the sample above; its own index if there is none.
  };
  struct Row {
    int v = 0;
    int first_u = 0, end_u = 0;      ///< The pixel columns that hold all samples of the row
    std::size_t begin = 0, end = 0;  ///< Indices of the row's samples
  };

  SampleLattice() = default;
  SampleLattice(const ImageMask& mask, int width_px, int height_px);

  const std::vector<Row>& rows() const { return rows_; }
  const std::vector<Sample>& samples() const { return samples_; }

 private:
  std::vector<Row> rows_;
  std::vector<Sample> samples_;
};

/// Limits outside which an image is unusable. Brightness is in 8-bit steps, 0 to 255; shares are of the visible
/// samples. The limits are absolute on purpose: a dim image is usable as long as something can be seen in it.
struct ImageWatchSettings {
  int dark_below = 24;         ///< This brightness and less counts as black
  double bright_share = 2e-3;  ///< Dark: fewer samples than this share are brighter than black. A few lamps are enough.
  int white_from = 250;
  double white_share = 0.5;  ///< Overexposed: more samples than this share are white.
  int contrast_above = 10;   ///< Neighbouring samples that differ by more show an edge; noise stays below.
  double edge_share = 2e-3;  ///< Featureless: fewer samples than this share show an edge.
  int frozen_repeats = 1;    ///< Frozen: the same image this many times again. Bearings of another instant do harm.
  /// Torn: a row exceeds every other row by this much in its likeness to a seam. See RowSeams.
  double seam_by = 0.5;
};

/// Judges consecutive images by a few thousand samples of the area that the rig's mask leaves visible.
///
/// `frozen` means that the image is identical to the last bit for the frozen_repeats-th time. Such an image has no new
/// information, so dropping it loses nothing even if the camera is fine, for example a simulated camera without noise
/// on a standing robot. A frozen image means camera trouble only if the robot has moved meanwhile, which this class
/// does not know.
///
/// `torn` means that rows of two instants meet in the image, or that its lower part was filled because data were
/// missing. A seam may stay undetected if both instants look alike or show nothing where they meet, unless the older
/// one was seen earlier as an image of its own.
/// Thread contract: thread-bound. Nothing allocates once an image of the largest size was seen.
class ImageWatch {
 public:
  explicit ImageWatch(const ImageRig& rig, const ImageWatchSettings& settings = {}) : rig_(rig), settings_(settings) {}

  /// Returns the worst trouble of the next image. `unreadable`: the image is not readable(), or the rig gives another
  /// image size. Any bytes are safe.
  ImageTrouble judge(const ImageView& image);

  /// How often in a row the last readable image repeated its predecessor.
  int repeats() const { return repeats_; }

 private:
  struct Counts {
    std::size_t bright = 0, white = 0, edges = 0;
  };

  void fit(const FrameFormat& format);
  /// Reads all samples and the digests of their rows, and returns the digest of all these rows.
  std::uint64_t read(const ImageView& image);
  bool says_something(const SampleLattice::Row& row) const;
  Counts count() const;
  void remember(std::uint64_t digest);
  ImageTrouble trouble(const Counts& counts) const;
  bool is_torn(const ImageView& image);

  ImageRig rig_;
  ImageWatchSettings settings_;
  SampleLattice lattice_;
  FrameFormat format_;  // The format for which the lattice and the seams are prepared
  RowSeams seams_;
  RowHistory history_;
  std::vector<std::uint8_t> row_;
  std::vector<int> samples_;             // Of each sample: the sum over its pixels.
  std::optional<std::uint64_t> digest_;  // Of the last readable image
  int repeats_ = 0;
};

}  // namespace azimuth
