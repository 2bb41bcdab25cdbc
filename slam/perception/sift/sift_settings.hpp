#pragma once
#include <cstdint>

namespace azimuth {

enum class SiftDetector : std::uint8_t {
  azimuth,  ///< our own
  opencv    ///< OpenCV's with its own orientations, as a reference; allocates for each image
};

/// The axes that a descriptor is measured along.
enum class DescriptorFrame : std::uint8_t {
  radial,  ///< away from the optical axis and across: a turn of the robot changes nothing
  image    ///< those of the image: descriptors do not match once the robot has turned (paper)
};

/// How key points are found, chosen and described (SPEC I.12). Pixels are those of the working image, intensities reach
/// from 0 to 1. The defaults measured best in rendered and ray-traced rooms; paper_sift_preset() is what the paper
/// prints.
struct SiftSettings {
  SiftDetector detector = SiftDetector::azimuth;

  // The working image.
  int side_px = 480;  ///< the mirror's disc is shrunk to a square of at most this size; 0: never

  // Scale space.
  int max_octaves = 4;           ///< each half the size of the one before, down to 4 x 4 pixels
  int scales_per_octave = 4;     ///< in which extrema are sought; an octave has three more images
  double first_sigma_px = 1.6;   ///< blur of an octave's first image, in its own pixels
  double camera_sigma_px = 0.5;  ///< blur that the working image has already

  // Which extrema are key points.
  double contrast = 0.018;        ///< least absolute difference of Gaussians at the extremum
  double contrast_light = 0.36;   ///< mean intensity below which that falls with the light; 0: it does not (paper)
  double curvature_ratio = 10.0;  ///< edges are refused: larger over smaller principal curvature, at most
  double clearance_sigmas = 3.0;  ///< least distance from anything hidden, in multiples of the key point's scale

  // How many of them.
  int target_count = 90;  ///< features in an image at most; 0: all
  int sectors = 30;       ///< of azimuth, between which features are shared out evenly; 1: the strongest anywhere

  // Descriptor.
  DescriptorFrame frame = DescriptorFrame::radial;
  double subregion_sigmas = 3.5;   ///< side of one of the 4 x 4 subregions, in multiples of the key point's scale
  double window_subregions = 1.5;  ///< standard deviation of the Gaussian weight about the middle
  double clip = 0.2;               ///< no component counts more than this in a descriptor of length 1

  // What a feature's place is worth.
  double sigma_place_px = 0.2;         ///< standard deviation of a key point's place along one axis, at scale 0
  double sigma_place_per_scale = 0.1;  ///< and for each pixel of its scale

  friend bool operator==(const SiftSettings&, const SiftSettings&) = default;
};

/// As printed: 7 octaves of 5 images, sigma 2.4, contrast 0.10, no frame of its own, every key point kept.
SiftSettings paper_sift_preset();

}  // namespace azimuth
