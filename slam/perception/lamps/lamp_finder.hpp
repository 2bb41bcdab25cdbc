#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/perception/lamps/bright_runs.hpp"
#include "slam/perception/lamps/lamp_blobs.hpp"
#include "slam/perception/lamps/lamp_settings.hpp"

namespace azimuth {

/// The pixels of an image that are searched, as runs.
///
/// Thread contract: reentrant.
class VisibleRows {
 public:
  VisibleRows() = default;
  /// `visible` has one byte a pixel, row by row; 0 marks hidden pixels.
  VisibleRows(const std::vector<std::uint8_t>& visible, int width_px, int height_px);

  /// Sorted by row from above, then from left to right.
  std::span<const PixelRun> runs() const { return runs_; }
  std::span<const PixelRun> row(int v) const;

  /// Whether a run of visible pixels touches a hidden pixel or the image's edge on the left, on the right, above or
  /// below.
  bool at_border(const PixelRun& run) const;

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }

 private:
  bool covers(int v, int first, int last) const;

  std::vector<PixelRun> runs_;
  std::vector<std::size_t> starts_;  // Of each row: the index of its first run in runs_; and the end index.
  int width_px_ = 0, height_px_ = 0;
};

/// Brightness levels of an image, in 8-bit steps.
struct Light {
  double background = 0.0;  ///< Median of the image
  double noise = 1.0;       ///< Standard deviation of the background, at least 1
  double lamps = 0.0;       ///< The level that LampSettings::light_share of the pixels reach
  int threshold = 255;      ///< Pixels of at least this level are bright; 1 to 255.
};

/// Follows the exposure: judges each image by a few thousand of its pixels. The threshold moves only if it is off by
/// more than a part of the contrast, so that the outlines of lamps do not change with the threshold from image to
/// image.
///
/// Thread contract: thread-bound. Nothing allocates.
class LightLevels {
 public:
  explicit LightLevels(const LampSettings& settings) : settings_(settings) {}

  /// Returns the levels of the next image. A visible part too small to hold a sample counts as dark.
  Light judge(const GrayView& image, const VisibleRows& visible);

 private:
  using Histogram = std::array<std::uint32_t, 256>;
  Histogram sample(const GrayView& image, const VisibleRows& visible) const;
  int follow(double wanted, double leeway);

  LampSettings settings_;
  int threshold_ = 0;  // Of the last image; 0 before the first image.
};

/// Finds bright spots that may be lamps, as far as the image alone can tell: bright enough, complete and single.
///
/// A spot that reaches the border of the visible area is left out, since the centre of a partly hidden lamp is unknown.
/// A spot that is a fragment of a lamp too thin to exceed the threshold everywhere is left out too. Two lamps that
/// merge into one spot are separated if a higher threshold separates them, and are left out otherwise.
///
/// Thread contract: thread-bound. Nothing allocates after construction.
class LampFinder {
 public:
  explicit LampFinder(const LampSettings& settings);

  /// Replaces the content of `out` with the spots in `image`, which must have the size of `visible`. Gives no spots for
  /// an image with more than kMostRuns bright runs.
  void find(const GrayView& image, const VisibleRows& visible, std::vector<LampBlob>& out);

  static constexpr std::size_t kMostRuns = std::size_t{1} << 16U;
  static constexpr int kMostArea_px = 1 << 20;

  const Light& light() const { return light_; }

 private:
  using Runs = std::span<const PixelRun>;
  static Runs scan(const GrayView& image, Runs where, int threshold, std::vector<PixelRun>& room);
  bool is_bright(const LampBlob& blob) const;
  bool is_whole(const VisibleRows& visible) const;
  bool goes_on(const GrayView& image, const LampBlob& blob) const;
  void take(const GrayView& image, const LampBlob& blob, std::vector<LampBlob>& out);
  bool part(const GrayView& image, int threshold, std::vector<LampBlob>& out);

  LampSettings settings_;
  LightLevels levels_;
  Light light_;
  LampBlobs blobs_, parts_;
  std::vector<PixelRun> runs_, part_runs_;  // Room for kMostRuns runs
  std::vector<PixelRun> blob_runs_;
};

}  // namespace azimuth
