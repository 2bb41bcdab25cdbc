#pragma once
#include "slam/perception/sift/descriptor.hpp"
#include "slam/perception/sift/extrema.hpp"
#include "slam/perception/sift/feature_finder.hpp"
#include "slam/perception/sift/scale_space.hpp"

namespace azimuth {

/// The built-in SIFT. Nothing allocates in the steady state.
class OwnSift final : public FeatureFinder {
 public:
  explicit OwnSift(const SiftSettings& settings, const ScaleSpaceKernels& kernels = scale_space_kernels());

  void detect(const Plane<std::uint16_t>& image, const VisibleRegion& region, std::vector<KeyPoint>& out) override;
  void describe(std::vector<KeyPoint>& key_points, std::vector<Descriptor>& out) override;

 private:
  FrameAxis axis_of(const KeyPoint& point) const;
  double contrast_in(const Plane<std::uint16_t>& image, const VisibleRegion& region) const;

  DescriptorFrame frame_;
  double contrast_, contrast_light_;
  float centre_px_ = 0.0F;
  ScaleSpace space_;
  ExtremumFinder finder_;
  DescriptorMaker maker_;
};

}  // namespace azimuth
