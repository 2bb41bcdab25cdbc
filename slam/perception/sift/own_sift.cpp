#include "slam/perception/sift/own_sift.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace azimuth {
namespace {

// Ten times the effect of sensor noise of two grey levels on the finest difference of Gaussians: 2 / 255 * 0.7
// (reduction of the image) * 0.045 (share of white noise that passes).
constexpr double kLeastContrast = 0.0025;
constexpr int kEveryRow = 4;  // Every fourth row is used to measure the light

/// The mean intensity of the visible part of an image, from 0 to 1.
double light_of(const Plane<std::uint16_t>& image, const VisibleRegion& region) {
  constexpr double kWhite = 255.0 * 256.0;
  std::uint64_t sum = 0, count = 0;
  for (int y = 0; y < image.height(); y += kEveryRow) {
    const VisibleRegion::Span span = region.span(y);
    if (span.first >= span.last) continue;
    sum = std::accumulate(image.row(y) + span.first, image.row(y) + span.last, sum);
    count += static_cast<std::uint64_t>(span.last - span.first);
  }
  return count == 0 ? 0.0 : static_cast<double>(sum) / (kWhite * static_cast<double>(count));
}

}  // namespace

OwnSift::OwnSift(const SiftSettings& settings, const ScaleSpaceKernels& kernels)
    : frame_(settings.frame),
      contrast_(settings.contrast),
      contrast_light_(settings.contrast_light),
      space_(settings, kernels),
      finder_(settings),
      maker_(settings) {}

/// Every difference is proportional to the light, so the contrast limit follows the light: the key points found do not
/// depend on the light, down to the noise. In more light than usual the limit stays, since there are enough key points.
double OwnSift::contrast_in(const Plane<std::uint16_t>& image, const VisibleRegion& region) const {
  if (contrast_light_ <= 0.0) return contrast_;
  const double dimmed = contrast_ * light_of(image, region) / contrast_light_;
  return std::clamp(dimmed, std::min(contrast_, kLeastContrast), contrast_);
}

void OwnSift::detect(const Plane<std::uint16_t>& image, const VisibleRegion& region, std::vector<KeyPoint>& out) {
  centre_px_ = 0.5F * static_cast<float>(image.width() - 1);
  space_.build(image);
  finder_.find(space_, region, contrast_in(image, region), out);
}

void OwnSift::describe(std::vector<KeyPoint>& key_points, std::vector<Descriptor>& out) {
  out.clear();
  for (const KeyPoint& point : key_points) out.push_back(maker_.describe(space_, point, axis_of(point)));
}

FrameAxis OwnSift::axis_of(const KeyPoint& point) const {
  if (frame_ == DescriptorFrame::image) return {};
  const float x = point.x_px - centre_px_, y = point.y_px - centre_px_;
  const float radius_px = std::sqrt(x * x + y * y);
  return radius_px > 0.0F ? FrameAxis{x / radius_px, y / radius_px} : FrameAxis{};
}

}  // namespace azimuth
