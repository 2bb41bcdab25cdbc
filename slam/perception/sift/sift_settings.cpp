#include "slam/perception/sift/sift_settings.hpp"

namespace azimuth {

SiftSettings paper_sift_preset() {
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
