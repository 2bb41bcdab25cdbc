#include "slam/perception/sift/scale_space.hpp"

#include <algorithm>
#include <cmath>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr int kSmallestSide_px = 4;
constexpr double kReachSigmas = 3.5;  // Beyond it, a Gaussian's weight is below 0.3 % of its peak

/// Weights of the centre, then outwards.
std::vector<float> gaussian_weights(double sigma_px) {
  const int radius = std::max(1, static_cast<int>(std::ceil(kReachSigmas * sigma_px)));
  std::vector<double> weights;
  double sum = 0.0;
  for (int i = 0; i <= radius; ++i) {
    weights.push_back(std::exp(-0.5 * i * i / (sigma_px * sigma_px)));
    sum += (i == 0 ? 1.0 : 2.0) * weights.back();
  }
  std::vector<float> normalised;
  for (const double weight : weights) normalised.push_back(static_cast<float>(weight / sum));
  return normalised;
}

/// The blur that must be added: variances add up.
double blur_between(double from_px, double to_px) {
  constexpr double kLeast_px = 0.1;
  return std::sqrt(std::max(to_px * to_px - from_px * from_px, kLeast_px * kLeast_px));
}

}  // namespace

ScaleSpace::ScaleSpace(const SiftSettings& settings, const ScaleSpaceKernels& kernels)
    : kernels_(kernels),
      scales_(settings.scales_per_octave),
      first_sigma_px_(static_cast<float>(settings.first_sigma_px)),
      first_blur_(gaussian_weights(blur_between(settings.camera_sigma_px, settings.first_sigma_px))) {
  const auto differences = as_size(scales_ + 2);
  const double step = std::exp2(1.0 / scales_);
  double sigma_px = settings.first_sigma_px;
  for (std::size_t i = 0; i < differences; ++i, sigma_px *= step)
    blurs_.push_back(gaussian_weights(blur_between(sigma_px, step * sigma_px)));
  for (int o = 0; o < settings.max_octaves; ++o) {
    Octave& octave = octaves_.emplace_back();
    octave.gaussians.resize(differences + 1);
    octave.differences.resize(differences);
  }
}

float ScaleSpace::sigma_px(float i) const { return first_sigma_px_ * std::exp2(i / static_cast<float>(scales_)); }

void ScaleSpace::build(const Plane<std::uint16_t>& image) {
  octaves_in_use_ = 0;
  for (std::size_t o = 0; o < octaves_.size(); ++o) {
    if ((std::min(image.width(), image.height()) >> o) < kSmallestSide_px) break;
    std::vector<Plane<float>>& gaussians = octaves_[o].gaussians;
    if (o == 0) {
      begin(image);
    } else {
      halve(octaves_[o - 1].gaussians[as_size(scales_)], gaussians[0]);
    }
    for (std::size_t i = 0; i < blurs_.size(); ++i)
      blur(gaussians[i], blurs_[i], gaussians[i + 1], &octaves_[o].differences[i]);
    ++octaves_in_use_;
  }
}

void ScaleSpace::begin(const Plane<std::uint16_t>& image) {
  intensity_.resize(image.width(), image.height());
  for (int y = 0; y < image.height(); ++y) kernels_.to_intensity(image.row(y), image.width(), intensity_.row(y));
  blur(intensity_, first_blur_, octaves_[0].gaussians[0], nullptr);
}

void ScaleSpace::blur(const Plane<float>& in, const Weights& weights, Plane<float>& out, Plane<float>* difference) {
  const int radius = static_cast<int>(weights.size()) - 1;
  out.resize(in.width(), in.height());
  if (difference != nullptr) difference->resize(in.width(), in.height());
  rows_.resize(in.width(), 2 * radius + 1);
  padded_.resize(in.width() + 2 * radius, 1);
  kernels_.blur({in.row(0), out.row(0), difference == nullptr ? nullptr : difference->row(0), in.width(), in.height(),
                 in.stride(), weights.data(), radius, rows_.row(0), padded_.row(0)});
}

void ScaleSpace::halve(const Plane<float>& in, Plane<float>& out) {
  out.resize(in.width() / 2, in.height() / 2);
  for (int y = 0; y < out.height(); ++y) {
    const float* from = in.row(2 * y);
    float* to = out.row(y);
    for (int x = 0; x < out.width(); ++x) to[x] = from[2 * x];
  }
}

}  // namespace azimuth
