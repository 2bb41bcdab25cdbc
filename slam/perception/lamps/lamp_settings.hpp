#pragma once
#include <cstdint>

namespace azimuth {

/// How pixels are converted to directions.
enum class CameraInverse : std::uint8_t {
  exact,  ///< The inverse of the camera model, also between pixels
  table   ///< A table with the interval of directions that each pixel covers (mathematics II.2, as in the paper)
};

/// How lamps are found in images from below (mathematics II.1). Brightness is in 8-bit steps. Sizes are those of the
/// lamp in the ceiling, in units of the ceiling's height above the camera. Unlike sizes in the image, or angles, they
/// do not depend on the robot's position, and bright objects on a wall appear huge in these units.
struct LampSettings {
  CameraInverse inverse = CameraInverse::exact;

  // Which pixels are bright. The threshold lies between the background and the light of lamps, both taken from the
  // image.
  double light_share = 1e-3;       ///< Share of the visible image that is at least as bright as lamps
  double threshold_share = 0.5;    ///< Position of the threshold between the background (0) and the light of lamps (1)
  double noise_factor = 6.0;       ///< The threshold exceeds the background by at least this many times the noise
  double min_contrast = 24.0;      ///< The threshold exceeds the background by at least this
  double threshold_inertia = 0.1;  ///< Greatest lag of the threshold, as a part of the range from background to light

  // Which blobs of bright pixels are lamps.
  int min_area_px = 6;
  double min_peak_share = 0.75;     ///< Least position of the brightest pixel between background (0) and light (1)
  double min_elevation_rad = 0.09;  ///< Lower pixels are not searched
  // Usual lamps (1.5 m long; 0.6 m square or 1.2 m by 0.3 m) under a ceiling at least 1.5 m above the camera.
  double max_length_heights = 1.0;
  double max_area_heights2 = 0.16;
  /// Least ratio of a blob's area to the area of the rectangle with the same moments; a blob with less is two lamps.
  double min_fill = 0.75;

  // Standard deviation of a lamp's position, along each axis.
  double blur_px = 0.6;            ///< Standard deviation of the lens's blur
  double sigma_place_px = 0.1;     ///< Other errors; the rig's sigma_px, if given, replaces this.
  double sigma_per_spread = 0.01;  ///< Uneven light, for each pixel of a lamp's standard deviation along that axis
  /// As sigma_per_spread, for a lamp so thin that the threshold removes all of its light in places
  double sigma_per_cut_spread = 0.2;

  friend bool operator==(const LampSettings&, const LampSettings&) = default;
};

}  // namespace azimuth
