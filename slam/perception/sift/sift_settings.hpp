#pragma once
#include <cstdint>

namespace azimuth {

enum class SiftDetector : std::uint8_t {
  azimuth,  ///< The built-in SIFT
  opencv    ///< OpenCV's SIFT with its own orientations, as a reference; allocates for each image.
};

/// The axes along which a descriptor is measured.
enum class DescriptorFrame : std::uint8_t {
  radial,  ///< Along and across the radius from the optical axis: descriptors do not depend on the robot's heading.
  image    ///< The axes of the image: descriptors do not match after the robot has turned (as in the paper).
};

/// How key points are found, selected and described (mathematics I.12). Pixels are those of the working image;
/// intensities range from 0 to 1. paper_sift_preset() gives the values printed in the paper.
struct SiftSettings {
  SiftDetector detector = SiftDetector::azimuth;

  // Working image.
  int side_px = 480;  ///< The mirror's disc is reduced to a square of at most this size; 0: no limit.

  // Scale space.
  int max_octaves = 4;           ///< Each octave has half the size of the previous one, down to 4 x 4 pixels
  int scales_per_octave = 4;     ///< Scales that are searched for extrema; an octave has three more images.
  double first_sigma_px = 1.6;   ///< Blur of an octave's first image, in its own pixels
  double camera_sigma_px = 0.5;  ///< Blur that the working image already has

  // Which extrema are key points.
  double contrast = 0.018;        ///< Least absolute difference of Gaussians at the extremum
  double contrast_light = 0.36;   ///< Mean intensity below which `contrast` is reduced in proportion; 0: never (paper).
  double curvature_ratio = 10.0;  ///< Greatest ratio of the two principal curvatures; edges have greater ratios
  double clearance_sigmas = 3.0;  ///< Least distance to a hidden pixel, in multiples of the key point's scale

  // How many key points are kept.
  int target_count = 90;  ///< Greatest number of features in an image; 0: no limit.
  /// Number of azimuth sectors over which features are evenly distributed; 1: the strongest features are kept, wherever
  /// they are.
  int sectors = 30;

  // Descriptor.
  DescriptorFrame frame = DescriptorFrame::radial;
  double subregion_sigmas = 3.5;   ///< Side of one of the 4 x 4 subregions, in multiples of the key point's scale
  double window_subregions = 1.5;  ///< Standard deviation of the Gaussian weight about the middle, in subregions
  double clip = 0.2;               ///< Greatest component of a descriptor normalised to length 1

  // Standard deviation of a feature's position.
  double sigma_place_px = 0.2;         ///< Standard deviation of a key point's position along one axis, at scale 0
  double sigma_place_per_scale = 0.1;  ///< Increase of `sigma_place_px` for each pixel of the key point's scale

  friend bool operator==(const SiftSettings&, const SiftSettings&) = default;
};

/// The values printed in the paper: 7 octaves of 5 images, sigma 2.4, contrast 0.10, image frame, every key point kept.
inline SiftSettings paper_sift_preset() {
  SiftSettings paper;
  paper.max_octaves = 7;        // From 480 to 7 pixels
  paper.scales_per_octave = 2;  // 5 images; neighbouring ones differ by a factor of sqrt 2.
  paper.first_sigma_px = 2.4;
  paper.contrast = 0.10;
  paper.contrast_light = 0.0;
  paper.curvature_ratio = 10.0;
  paper.target_count = 0;
  paper.frame = DescriptorFrame::image;
  paper.subregion_sigmas = 3.0;
  paper.window_subregions = 1.5;
  return paper;
}

}  // namespace azimuth
