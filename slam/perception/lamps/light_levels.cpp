#include "slam/perception/lamps/light_levels.hpp"

#include <algorithm>
#include <cmath>

#include "slam/geometry/index.hpp"

namespace azimuth {
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

}  // namespace azimuth
