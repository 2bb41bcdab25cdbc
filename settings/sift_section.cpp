
#include "settings/configuration_sections.hpp"

namespace azimuth {
namespace {

std::vector<Key> detector_keys(SiftSettings& sift) {
  return {
      choice<SiftDetector>("detector", sift.detector,
                           {{"azimuth", SiftDetector::azimuth}, {"opencv", SiftDetector::opencv}},
                           "azimuth: our own; opencv: OpenCV's, several times slower, to compare with."),
      {"side_px", &sift.side_px, "The mirror's disc is shrunk to a square of this size at most; 0: never.",
       from_to(0, 4096)},
      {"max_octaves", &sift.max_octaves, "Octaves of the scale space, each half the size of the one before.",
       from_to(1, 12)},
      {"scales_per_octave", &sift.scales_per_octave, "Scales of an octave in which extrema are sought.", from_to(1, 8)},
      {"first_sigma_px", &sift.first_sigma_px, "Blur of an octave's first image, in its own pixels.", from_to(0.5, 8)},
      {"camera_sigma_px", &sift.camera_sigma_px, "Blur that images have from the camera.", from_to(0, 4)},
      everyday({"contrast", &sift.contrast, "Least difference of Gaussians of a feature, for intensities from 0 to 1.",
                above_to(0, 1)}),
      {"contrast_light", &sift.contrast_light,
       "Mean intensity of an image below which `contrast` falls with the light; 0: it does not.", from_to(0, 1)},
      {"curvature_ratio", &sift.curvature_ratio, "Edges are refused: larger over smaller curvature, at most.",
       from_to(1, 1000)},
      {"clearance_sigmas", &sift.clearance_sigmas,
       "Least distance of a feature from anything hidden, in multiples of its scale.", from_to(0, 20)},
  };
}

std::vector<Key> feature_keys(SiftSettings& sift) {
  return {
      everyday({"target_count", &sift.target_count, "Features in an image at most; 0: all.", from_to(0, 4096)}),
      {"sectors", &sift.sectors, "Sectors of azimuth among which features are shared out; 1: the strongest anywhere.",
       from_to(1, 360)},
      choice<DescriptorFrame>("frame", sift.frame,
                              {{"radial", DescriptorFrame::radial}, {"image", DescriptorFrame::image}},
                              "Axes of descriptors. radial: away from the optical axis, so that turns of the robot "
                              "change nothing; image: its rows and columns, as in the paper."),
      {"subregion_sigmas", &sift.subregion_sigmas,
       "Side of one of a descriptor's 4 x 4 subregions, in multiples of the feature's scale.", from_to(0.5, 20)},
      {"window_subregions", &sift.window_subregions,
       "Standard deviation of a descriptor's Gaussian weight, in subregions.", from_to(0.1, 100)},
      {"clip", &sift.clip, "No component counts more than this in a descriptor of length 1.", above_to(0, 1)},
      {"sigma_place_px", &sift.sigma_place_px,
       "Standard deviation of a feature's place along one axis of the square, at scale 0.", above_to(0, 100)},
      {"sigma_place_per_scale", &sift.sigma_place_per_scale,
       "Standard deviation of a feature's place for each pixel of its scale, in quadrature.", from_to(0, 10)},
  };
}

}  // namespace

Section sift_section(SiftSettings& sift, Preset& preset) {
  return {
      "sift", "Features in the images of the front end \"sift\".",
      joined({{preset_key(
                  preset,
                  "Values of the keys not given here. paper: as printed; loses its features when the robot turns.")},
              detector_keys(sift),
              feature_keys(sift)})};
}

}  // namespace azimuth
