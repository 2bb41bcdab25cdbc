#pragma once
#include <cstdint>
#include <vector>

#include "slam/geometry/index.hpp"
#include "slam/perception/image/plane.hpp"
#include "slam/perception/sift/scale_space_kernels.hpp"
#include "slam/perception/sift/sift_settings.hpp"

namespace azimuth {

/// A square image at growing blur, in octaves of half the size each. Pixel (x, y) of octave o is pixel (2^o x, 2^o y)
/// of the image.
///
/// Thread contract: thread-bound. Nothing allocates once storage has grown to the largest image. The same image gives
/// the same bits on every processor.
class ScaleSpace {
 public:
  explicit ScaleSpace(const SiftSettings& settings, const ScaleSpaceKernels& kernels = scale_space_kernels());

  /// `image` holds values in 1/256 of a grey level.
  void build(const Plane<std::uint16_t>& image);

  /// Number of octaves of the last image.
  int octaves() const { return octaves_in_use_; }
  int scales() const { return scales_; }
  /// Images 0 to scales() + 2; image i has a blur of sigma_px(i) in pixels of the octave.
  const Plane<float>& gaussian(int octave, int i) const { return at(octave).gaussians[as_size(i)]; }
  /// Differences 0 to scales() + 1: gaussian(i + 1) - gaussian(i).
  const Plane<float>& difference(int octave, int i) const { return at(octave).differences[as_size(i)]; }
  /// Also defined for fractional `i`.
  float sigma_px(float i) const;

  const ScaleSpaceKernels& kernels() const { return kernels_; }

 private:
  struct Octave {
    std::vector<Plane<float>> gaussians, differences;
  };
  using Weights = std::vector<float>;

  const Octave& at(int octave) const { return octaves_[as_size(octave)]; }
  void blur(const Plane<float>& in, const Weights& weights, Plane<float>& out, Plane<float>* difference);
  void begin(const Plane<std::uint16_t>& image);
  void halve(const Plane<float>& in, Plane<float>& out);

  ScaleSpaceKernels kernels_;
  int scales_;
  float first_sigma_px_;
  Weights first_blur_;          // From the camera's blur to that of the first image
  std::vector<Weights> blurs_;  // From image i to image i + 1
  Plane<float> intensity_, rows_, padded_;
  std::vector<Octave> octaves_;
  int octaves_in_use_ = 0;
};

}  // namespace azimuth
