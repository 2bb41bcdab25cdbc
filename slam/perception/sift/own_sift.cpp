#include "slam/perception/sift/own_sift.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

/// The angle of (x, y) in eighths of a turn, in [0, 8], by a polynomial for the arc tangent from 0 to 1. Its error is
/// less than 0.0002 eighths. The library's arc tangent would take most of a descriptor's time.
float eighths(float y, float x) {
  const float ax = std::abs(x), ay = std::abs(y);
  const float ratio = std::min(ax, ay) / std::max(std::max(ax, ay), 1e-30F);
  const float square = ratio * ratio;
  const float arc =
      ratio *
      (0.99997726F +
       square * (-0.33262347F +
                 square * (0.19354346F + square * (-0.11643287F + square * (0.05265332F - square * 0.01172120F)))));
  float result = arc * (4.0F / std::numbers::pi_v<float>);
  if (ay > ax) result = 2.0F - result;
  if (x < 0.0F) result = 4.0F - result;
  return y < 0.0F ? 8.0F - result : result;
}

/// Bilinear interpolation between pixels; beyond the edge, the edge pixels are repeated.
float interpolate(const Plane<float>& plane, float x, float y) {
  x = std::clamp(x, 0.0F, static_cast<float>(plane.width() - 1));
  y = std::clamp(y, 0.0F, static_cast<float>(plane.height() - 1));
  const int left = std::min(static_cast<int>(x), plane.width() - 2);
  const int top = std::min(static_cast<int>(y), plane.height() - 2);
  const float right_share = x - static_cast<float>(left), low_share = y - static_cast<float>(top);
  const float* above = plane.row(top) + left;
  const float* below = plane.row(top + 1) + left;
  const float high = above[0] + right_share * (above[1] - above[0]);
  const float low = below[0] + right_share * (below[1] - below[0]);
  return high + low_share * (low - high);
}

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

DescriptorMaker::DescriptorMaker(const SiftSettings& settings)
    : subregion_sigmas_(static_cast<float>(settings.subregion_sigmas)), clip_(static_cast<float>(settings.clip)) {
  for (int i = 0; i < kGradients; ++i) {
    const double subregions_from_middle = (i + 0.5 - 0.5 * kGradients) / kSamplesPerSubregion;
    const double place = subregions_from_middle + 0.5 * kSubregions - 0.5;  // 0 is the middle of the first subregion
    const double first = std::floor(place), off = subregions_from_middle / settings.window_subregions;
    const double window = std::exp(-0.5 * off * off);
    shares_[as_size(i)] = {static_cast<int>(first), static_cast<float>(window * (first + 1.0 - place)),
                           static_cast<float>(window * (place - first))};
  }
}

Descriptor DescriptorMaker::describe(const ScaleSpace& space, const KeyPoint& point, const FrameAxis& axis) {
  sample(space, point, axis);
  cells_.fill(0.0F);
  for (int row = 0; row < kGradients; ++row)
    for (int column = 0; column < kGradients; ++column) add_gradient(column, row);
  return normalised();
}

void DescriptorMaker::sample(const ScaleSpace& space, const KeyPoint& point, const FrameAxis& axis) {
  const Plane<float>& image = space.gaussian(point.octave, point.layer);
  const float to_octave = 1.0F / static_cast<float>(1 << point.octave);
  const float step_px = to_octave * point.sigma_px * subregion_sigmas_ / kSamplesPerSubregion;
  const float along_x = step_px * axis.x, along_y = step_px * axis.y;
  for (int row = 0; row < kSamples; ++row) {
    for (int column = 0; column < kSamples; ++column) {
      const float a = static_cast<float>(column) - 0.5F * (kSamples - 1);
      const float b = static_cast<float>(row) - 0.5F * (kSamples - 1);
      samples_[as_size(row)][as_size(column)] = interpolate(image, to_octave * point.x_px + a * along_x - b * along_y,
                                                            to_octave * point.y_px + a * along_y + b * along_x);
    }
  }
}

void DescriptorMaker::add_gradient(int column, int row) {
  const auto c = as_size(column + 1), r = as_size(row + 1);
  const float along = samples_[r][c + 1] - samples_[r][c - 1], across = samples_[r + 1][c] - samples_[r - 1][c];
  const float length = std::sqrt(along * along + across * across);
  const float angle = eighths(across, along);
  const int direction = std::min(static_cast<int>(angle), kDirections - 1);
  const float next = length * (angle - static_cast<float>(direction)), here = length - next;

  const Share& x = shares_[c - 1];
  const Share& y = shares_[r - 1];
  float* low = &cells_[as_size(((y.first + 1) * (kSubregions + 2) + x.first + 1) * (kDirections + 1) + direction)];
  float* high = low + (kSubregions + 2) * (kDirections + 1);
  const auto add = [&](float* cell, float weight) {
    cell[0] += weight * here;
    cell[1] += weight * next;
  };
  add(low, y.weight_of_first * x.weight_of_first);
  add(low + kDirections + 1, y.weight_of_first * x.weight_of_next);
  add(high, y.weight_of_next * x.weight_of_first);
  add(high + kDirections + 1, y.weight_of_next * x.weight_of_next);
}

Descriptor DescriptorMaker::normalised() const {
  std::array<float, 128> values{};
  float squares = 0.0F;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t direction = i % kDirections, region = i / kDirections;
    const std::size_t cell = ((region / kSubregions + 1) * (kSubregions + 2) + region % kSubregions + 1) * 9;
    values[i] = cells_[cell + direction] + (direction == 0 ? cells_[cell + kDirections] : 0.0F);
    squares += values[i] * values[i];
  }
  const float limit = clip_ * std::sqrt(squares);
  squares = 0.0F;
  for (float& value : values) {
    value = std::min(value, limit);
    squares += value * value;
  }
  Descriptor descriptor;
  if (!(squares > 0.0F)) return descriptor;
  const float factor = 512.0F / std::sqrt(squares);
  for (std::size_t i = 0; i < values.size(); ++i)
    descriptor.values[i] = static_cast<std::uint8_t>(std::min(255.0F, std::round(factor * values[i])));
  return descriptor;
}

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
