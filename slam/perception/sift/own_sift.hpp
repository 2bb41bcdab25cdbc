#pragma once
#include <array>

#include "slam/perception/sift/extrema.hpp"
#include "slam/perception/sift/feature_finder.hpp"
#include "slam/perception/sift/scale_space.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// The unit vector along the first axis of a descriptor, with x to the right and y down.
struct FrameAxis {
  float x = 1.0F;
  float y = 0.0F;
};

/// Describes key points by the image gradients in 4 x 4 subregions of 8 directions (mathematics I.12).
///
/// The surroundings of a key point are sampled on a grid that is rotated to the descriptor's frame and scaled to the
/// key point. Each sample therefore contributes to the same subregions in every descriptor, with weights that are
/// computed once. Four samples a subregion along each axis lose nothing, since the image is blurred to the key point's
/// scale.
///
/// Thread contract: thread-bound. Nothing allocates.
class DescriptorMaker {
 public:
  explicit DescriptorMaker(const SiftSettings& settings);

  Descriptor describe(const ScaleSpace& space, const KeyPoint& point, const FrameAxis& axis);

 private:
  static constexpr int kSubregions = 4;  // Along each axis
  static constexpr int kDirections = 8;
  static constexpr int kSamplesPerSubregion = 4;
  // Samples up to half a subregion beyond the descriptor still contribute to its outer subregions.
  static constexpr int kGradients = (kSubregions + 1) * kSamplesPerSubregion;
  static constexpr int kSamples = kGradients + 2;

  /// Weights with which a row (or column) of gradients contributes to two neighbouring subregions.
  struct Share {
    int first = 0;  // Index of the first subregion; -1 if the first weight belongs to none.
    float weight_of_first = 0.0F, weight_of_next = 0.0F;
  };
  using Cells = std::array<float, (kSubregions + 2) * (kSubregions + 2) * (kDirections + 1)>;

  void sample(const ScaleSpace& space, const KeyPoint& point, const FrameAxis& axis);
  void add_gradient(int column, int row);
  Descriptor normalised() const;

  float subregion_sigmas_, clip_;
  std::array<Share, kGradients> shares_;
  std::array<std::array<float, kSamples>, kSamples> samples_{};
  Cells cells_{};  // With a margin of one subregion all round, and direction 0 repeated at the end
};

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
