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
