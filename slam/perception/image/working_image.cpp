#include "slam/perception/image/working_image.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "slam/geometry/index.hpp"
#include "slam/perception/image/gray.hpp"
#include "slam/perception/image/resample_kernels.hpp"

namespace azimuth {
namespace {

constexpr int kOne = 256;  // Sum of the weights of an output pixel

/// Triangular weights of half-width `reach` about `middle`, folded onto the pixels inside the image.
void triangle(double middle, double reach, int inputs, int& first, std::vector<double>& weights) {
  first = static_cast<int>(std::floor(middle - reach)) + 1;
  const int last = static_cast<int>(std::ceil(middle + reach)) - 1;
  weights.assign(1, 0.0);
  const int low = std::clamp(first, 0, inputs - 1);
  for (int pixel = first; pixel <= last; ++pixel) {
    const auto place = as_size(std::clamp(pixel, 0, inputs - 1) - low);
    if (place >= weights.size()) weights.resize(place + 1, 0.0);
    weights[place] += 1.0 - std::abs(pixel - middle) / reach;
  }
  first = low;
}

/// Appends integers in proportion to `weights` that add up to kOne exactly.
void append_whole(const std::vector<double>& weights, std::vector<std::uint16_t>& out) {
  double total = 0.0, so_far = 0.0;
  for (const double weight : weights) total += weight;
  int given = 0;
  for (const double weight : weights) {
    so_far += weight;
    const int now = static_cast<int>(std::lround(kOne * so_far / total));
    out.push_back(static_cast<std::uint16_t>(now - given));
    given = now;
  }
}

}  // namespace

WorkingSquare working_square(const ImageAxes& axes, double radius_px, int most_px) {
  assert(radius_px > 0.0);
  const double native_px = std::ceil(2.0 * radius_px);
  const bool shrink = most_px > 0 && native_px > most_px;
  const double side_px = shrink ? most_px : native_px;
  return {axes, radius_px, static_cast<int>(side_px), shrink ? side_px / (2.0 * radius_px) : 1.0};
}

WorkingImage::WorkingImage(const WorkingSquare& square, int width_px, int height_px)
    : width_px_(width_px),
      height_px_(height_px),
      columns_(axis(square.camera_pixel(0.0, 0.0).x(), 1.0 / square.scale, square.side_px, width_px)),
      rows_(axis(square.camera_pixel(0.0, 0.0).y(), square.axes.beta / square.scale, square.side_px, height_px)),
      first_column_(columns_.taps.front().first),
      last_column_(columns_.taps.back().first + columns_.taps.back().count) {
  int most = 1;
  for (const Taps& taps : rows_.taps) most = std::max(most, taps.count);
  const auto room = as_size(last_column_ - first_column_ + kResampleLanes);
  kept_.assign(as_size(most), std::vector<std::uint8_t>(room));
  kept_row_.assign(kept_.size(), -1);
  sums_.resize(room);
}

WorkingImage::Axis WorkingImage::axis(double first_px, double step_px, int outputs, int inputs) {
  Axis axis;
  std::vector<double> weights;
  for (int i = 0; i < outputs; ++i) {
    Taps taps;
    triangle(first_px + step_px * i, std::max(1.0, step_px), inputs, taps.first, weights);
    taps.count = static_cast<int>(weights.size());
    taps.weights = axis.weights.size();
    append_whole(weights, axis.weights);
    axis.taps.push_back(taps);
  }
  return axis;
}

const std::uint8_t* WorkingImage::gray(const ImageView& image, int row) {
  const std::size_t place = as_size(row) % kept_.size();
  if (kept_row_[place] != row) gray_row(image, row, first_column_, last_column_, kept_[place].data());
  kept_row_[place] = row;
  return kept_[place].data();
}

void WorkingImage::squeeze(const std::uint16_t* sums, std::uint16_t* out) const {
  const std::uint16_t* weight = columns_.weights.data();
  for (const Taps& taps : columns_.taps) {
    const std::uint16_t* sum = sums + (taps.first - first_column_);
    std::uint32_t total = 0;
    for (int i = 0; i < taps.count; ++i) total += std::uint32_t{sum[i]} * *weight++;
    *out++ = static_cast<std::uint16_t>((total + kOne / 2) / kOne);
  }
}

void WorkingImage::make(const ImageView& image, Plane<std::uint16_t>& out) {
  assert(image.readable() && image.format.width_px == width_px_ && image.format.height_px == height_px_);
  const int side = static_cast<int>(rows_.taps.size());
  out.resize(side, side);
  std::ranges::fill(kept_row_, -1);
  for (int y = 0; y < side; ++y) {
    const Taps& taps = rows_.taps[as_size(y)];
    std::ranges::fill(sums_, std::uint16_t{0});
    for (int i = 0; i < taps.count; ++i)
      add_weighted(gray(image, taps.first + i), rows_.weights[taps.weights + as_size(i)], last_column_ - first_column_,
                   sums_.data());
    squeeze(sums_.data(), out.row(y));
  }
}

}  // namespace azimuth
