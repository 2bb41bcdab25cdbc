#pragma once
#include <cstdint>

namespace azimuth {

/// How pixels become directions.
enum class CameraInverse : std::uint8_t {
  exact,  ///< the model's own inverse, between pixels as well
  table   ///< a table with the interval of directions that each pixel covers (SPEC II.2, as the paper does it)
};

/// How lamps are found in images from below (SPEC II.1). Brightness is in 8-bit steps. Sizes are those of the lamp in
/// its ceiling, in units of the ceiling's height above the camera: unlike sizes in the image, or angles, they are the
/// same wherever the robot is, and what hangs on a wall is huge in them.
struct LampSettings {
  CameraInverse inverse = CameraInverse::exact;

  // Which pixels shine: between the background and the light of lamps, which the image itself tells.
  double light_share = 1e-3;       ///< of the visible image that is as bright as lamps are, or more
  double threshold_share = 0.5;    ///< of the way from the background to that light
  double noise_factor = 6.0;       ///< the threshold is above the background by this many times the noise,
  double min_contrast = 24.0;      ///< and by this
  double threshold_inertia = 0.1;  ///< part of the way from background to light that the threshold may lag behind

  // Which blobs of them are lamps.
  int min_area_px = 6;
  double min_peak_share = 0.75;     ///< brightest pixel, on the way from background to light
  double min_elevation_rad = 0.09;  ///< lower down, nothing is looked at
  // What is usual (1.5 m long; 0.6 m square or 1.2 m by 0.3 m) where a ceiling is 1.5 m above the camera, or more.
  double max_length_heights = 1.0;
  double max_area_heights2 = 0.16;
  double min_fill = 0.75;  ///< area over that of a rectangle with the same moments; less: two lamps in one

  // What a lamp's place is worth, along each axis.
  double blur_px = 0.6;            ///< standard deviation of the lens's blur
  double sigma_place_px = 0.1;     ///< whatever else is unknown; the rig's sigma_px, where it says one, replaces this
  double sigma_per_spread = 0.01;  ///< uneven light, for each pixel of a lamp's standard deviation along that axis
  double sigma_per_cut_spread =
      0.2;  ///< likewise, of a lamp so thin that the threshold cuts all of its light in places

  friend bool operator==(const LampSettings&, const LampSettings&) = default;
};

}  // namespace azimuth
