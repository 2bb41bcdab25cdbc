#pragma once
#include <span>
#include <vector>

#include "slam/perception/lamps/bright_runs.hpp"
#include "slam/perception/lamps/gray_view.hpp"
#include "slam/perception/lamps/lamp_blobs.hpp"
#include "slam/perception/lamps/lamp_settings.hpp"
#include "slam/perception/lamps/light_levels.hpp"
#include "slam/perception/lamps/visible_rows.hpp"

namespace azimuth {

/// Finds bright spots, as far as the image alone tells what may be a lamp: bright enough, whole, and one.
///
/// A spot that reaches the border of what is visible is left out, since the middle of what is hidden is not known; so
/// is one that is a piece of a lamp too thin to be above the threshold everywhere. Two lamps that run into each other
/// are parted where a higher threshold parts them, else left out.
///
/// Thread contract: thread-bound. Nothing allocates after construction.
class LampFinder {
 public:
  explicit LampFinder(const LampSettings& settings);

  /// Replaces `out` by the spots in an image of the size of `visible`. An image with more than kMostRuns bright runs
  /// shows none.
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
  std::vector<PixelRun> runs_, part_runs_;  // room for kMostRuns
  std::vector<PixelRun> blob_runs_;
};

}  // namespace azimuth
