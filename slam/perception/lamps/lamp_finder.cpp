#include "slam/perception/lamps/lamp_finder.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "slam/geometry/index.hpp"

namespace azimuth {

VisibleRows::VisibleRows(const std::vector<std::uint8_t>& visible, int width_px, int height_px)
    : width_px_(width_px), height_px_(height_px) {
  const std::uint8_t* pixels = visible.data();
  for (int v = 0; v < height_px; ++v, pixels += width_px) {
    starts_.push_back(runs_.size());
    const std::uint8_t *at = pixels, *const end = pixels + width_px;
    while ((at = std::find_if(at, end, [](std::uint8_t each) { return each != 0; })) != end) {
      const std::uint8_t* const first = at;
      at = std::find(at, end, std::uint8_t{0});
      runs_.push_back({v, static_cast<std::int32_t>(first - pixels), static_cast<std::int32_t>(at - pixels)});
    }
  }
  starts_.push_back(runs_.size());
}

std::span<const PixelRun> VisibleRows::row(int v) const {
  if (v < 0 || v >= height_px_) return {};
  const std::size_t begin = starts_[as_size(v)], end = starts_[as_size(v) + 1];
  return std::span(runs_).subspan(begin, end - begin);
}

bool VisibleRows::covers(int v, int first, int last) const {
  return std::ranges::any_of(row(v), [&](const PixelRun& run) { return run.first <= first && last <= run.last; });
}

bool VisibleRows::at_border(const PixelRun& run) const {
  return !covers(run.row, run.first - 1, run.last + 1) || !covers(run.row - 1, run.first, run.last) ||
         !covers(run.row + 1, run.first, run.last);
}

namespace {

constexpr double kSamples = 10'000;  // Approximate; the median of so many samples is good to a hundredth of the noise.
// The counts alternate between tables, since two increments of one counter in a row would stall
constexpr std::size_t kTables = 4;

/// Distance between samples, along rows and from row to row.
int spacing_px(int width_px, int height_px) {
  return std::max(1, static_cast<int>(std::sqrt(static_cast<double>(width_px) * height_px / kSamples)));
}

/// The smallest value that a part `share` of all samples does not exceed.
int quantile(const std::array<std::uint32_t, 256>& histogram, double share) {
  double total = 0.0, below = 0.0;
  for (const std::uint32_t count : histogram) total += count;
  for (int value = 0; value < 255; ++value) {
    below += histogram[as_size(value)];
    if (below >= share * total) return value;
  }
  return 255;
}

}  // namespace

LightLevels::Histogram LightLevels::sample(const GrayView& image, const VisibleRows& visible) const {
  const int spacing = spacing_px(image.width_px, image.height_px);
  std::array<Histogram, kTables> tables{};
  for (int v = spacing / 2; v < image.height_px; v += spacing) {
    const std::uint8_t* const pixels = image.row(v);
    std::size_t turn = 0;
    for (const PixelRun& run : visible.row(v))
      for (int u = run.first; u < run.last; u += spacing) ++tables[turn++ % kTables][pixels[u]];
  }
  for (std::size_t k = 1; k < kTables; ++k)
    for (std::size_t value = 0; value < tables[0].size(); ++value) tables[0][value] += tables[k][value];
  return tables[0];
}

Light LightLevels::judge(const GrayView& image, const VisibleRows& visible) {
  const Histogram histogram = sample(image, visible);
  Light light;
  light.background = quantile(histogram, 0.5);
  // 68 % of a normal distribution lie within one standard deviation. Only the lower side is used, since lamps are on
  // the upper side.
  light.noise = std::max(1.0, light.background - quantile(histogram, 0.16));
  light.lamps = quantile(histogram, 1.0 - settings_.light_share);
  const double contrast = light.lamps - light.background;
  const double above =
      std::max({settings_.threshold_share * contrast, settings_.noise_factor * light.noise, settings_.min_contrast});
  light.threshold = follow(light.background + above, settings_.threshold_inertia * contrast);
  return light;
}

int LightLevels::follow(double wanted, double leeway) {
  if (threshold_ == 0 || std::abs(wanted - threshold_) > leeway)
    threshold_ = static_cast<int>(std::lround(std::clamp(wanted, 1.0, 255.0)));
  return threshold_;
}

LampFinder::LampFinder(const LampSettings& settings)
    : settings_(settings), levels_(settings), runs_(kMostRuns), part_runs_(kMostRuns) {
  blob_runs_.reserve(kMostRuns);
  blobs_.reserve(kMostRuns);
  parts_.reserve(kMostRuns);
}

void LampFinder::find(const GrayView& image, const VisibleRows& visible, std::vector<LampBlob>& out) {
  out.clear();
  light_ = levels_.judge(image, visible);
  blobs_.group(image, scan(image, visible.runs(), light_.threshold, runs_), light_.threshold);
  for (std::size_t k = 0; k < blobs_.all().size(); ++k) {
    const LampBlob& blob = blobs_.all()[k];
    if (blob.area_px < settings_.min_area_px || blob.area_px > kMostArea_px || !is_bright(blob)) continue;
    blobs_.runs_of(k, blob_runs_);
    if (is_whole(visible)) take(image, blob, out);
  }
}

/// Returns no runs if there is no room for all.
LampFinder::Runs LampFinder::scan(const GrayView& image, Runs where, int threshold, std::vector<PixelRun>& room) {
  std::size_t count = 0;
  for (const PixelRun& stretch : where) {
    count += bright_runs(image.row(stretch.row), stretch, threshold, room.data() + count, room.size() - count);
    if (count == room.size()) return {};
  }
  return {room.data(), count};
}

/// Whether the blob is bright enough to be a source of light and not a lit surface.
bool LampFinder::is_bright(const LampBlob& blob) const {
  return blob.peak - light_.background >= settings_.min_peak_share * (light_.lamps - light_.background);
}

bool LampFinder::is_whole(const VisibleRows& visible) const {
  return std::ranges::none_of(blob_runs_, [&visible](const PixelRun& run) { return visible.at_border(run); });
}

/// Whether the lamp continues beyond an end of the blob, darker than the threshold. A lamp at least two pixels thick
/// fills at least one pixel everywhere, so all of it exceeds the threshold.
bool LampFinder::goes_on(const GrayView& image, const LampBlob& blob) const {
  constexpr double kThin_px = 2.0;
  // At this distance no light of a complete lamp is left, with lens blur and perspective allowed for.
  constexpr double kBeyond_px = 1.5, kBeyondPerLength = 0.1;
  const LampBlob::Rectangle lamp = blob.rectangle();
  if (lamp.thickness_px >= kThin_px) return false;
  const double still_light = 0.5 * (light_.background + light_.threshold);
  const auto is_light = [&](const Pixel& at) {
    const int u = static_cast<int>(std::floor(at.x())), v = static_cast<int>(std::floor(at.y()));
    for (const int row : {v, v + 1})
      for (const int column : {u, u + 1})
        if (row >= 0 && row < image.height_px && column >= 0 && column < image.width_px &&
            image.row(row)[column] > still_light)
          return true;
    return false;
  };
  const Eigen::Vector2d end_px = ((0.5 + kBeyondPerLength) * lamp.length_px + kBeyond_px) * lamp.along;
  return is_light(blob.centroid + end_px) || is_light(blob.centroid - end_px);
}

void LampFinder::take(const GrayView& image, const LampBlob& blob, std::vector<LampBlob>& out) {
  if (blob.fill() >= settings_.min_fill) {
    if (!goes_on(image, blob)) out.push_back(blob);
    return;
  }
  constexpr int kLevels = 4;
  for (int k = 1; k < kLevels; ++k)
    if (part(image, light_.threshold + (blob.peak - light_.threshold) * k / kLevels, out)) return;
}

/// Splits the blob whose runs are in blob_runs_ at a higher threshold. Succeeds if at least two parts are complete
/// lamps.
bool LampFinder::part(const GrayView& image, int threshold, std::vector<LampBlob>& out) {
  parts_.group(image, scan(image, blob_runs_, threshold, part_runs_), threshold);
  const auto is_lamp = [&](const LampBlob& blob) {
    return blob.area_px >= settings_.min_area_px && is_bright(blob) && blob.fill() >= settings_.min_fill &&
           !goes_on(image, blob);
  };
  if (std::ranges::count_if(parts_.all(), is_lamp) < 2) return false;
  std::ranges::copy_if(parts_.all(), std::back_inserter(out), is_lamp);
  return true;
}

}  // namespace azimuth
