
#include "settings/configuration_sections.hpp"

namespace azimuth {
namespace {

std::vector<Key> light_keys(LampSettings& lamps) {
  return {
      choice<CameraInverse>("inverse", lamps.inverse,
                            {{"exact", CameraInverse::exact}, {"table", CameraInverse::table}},
                            "exact: directions from the camera's model; table: from what each pixel covers (paper)."),
      {"light_share", &lamps.light_share, "Part of the visible image that is as bright as lamps are, or more.",
       above_to(0, 0.5)},
      {"threshold_share", &lamps.threshold_share,
       "What shines is brighter than this part of the way from the background to the light of lamps.", above_to(0, 1)},
      {"noise_factor", &lamps.noise_factor, "What shines is brighter than the background by so many times its noise.",
       from_to(0, 100)},
      {"min_contrast", &lamps.min_contrast, "What shines is brighter than the background by this at least, of 255.",
       from_to(1, 255)},
      {"threshold_inertia", &lamps.threshold_inertia,
       "Part of the way from background to light that the threshold may lag behind, so that outlines stand still.",
       from_to(0, 1)},
  };
}

std::vector<Key> shape_keys(LampSettings& lamps) {
  return {
      {"min_area_px", &lamps.min_area_px, "A lamp has as many pixels at least.", from_to(1, 100'000)},
      {"min_peak_share", &lamps.min_peak_share,
       "A lamp's brightest pixel is as far on the way from background to light: windows and reflections are not.",
       from_to(0, 1)},
      everyday(
          {"min_elevation_rad", &lamps.min_elevation_rad, "Lower down, nothing is looked at.", from_to(0.02, 1.5)}),
      {"max_length_heights", &lamps.max_length_heights,
       "Length of a lamp at most, in heights of the ceiling above the camera.", above_to(0, 100)},
      {"max_area_heights2", &lamps.max_area_heights2,
       "Area of a lamp at most, in squares of the ceiling's height above the camera.", above_to(0, 10'000)},
      {"min_fill", &lamps.min_fill,
       "Area of a lamp over that of a rectangle with the same moments; less: two lamps that run into each other.",
       from_to(0, 1)},
  };
}

std::vector<Key> noise_keys(LampSettings& lamps) {
  return {
      {"blur_px", &lamps.blur_px, "Blur of the lens.", from_to(0, 10)},
      {"sigma_place_px", &lamps.sigma_place_px,
       "Standard deviation of a lamp's middle along one axis; the rig's sigma_px replaces it.", above_to(0, 100)},
      {"sigma_per_spread", &lamps.sigma_per_spread,
       "Standard deviation of a lamp's middle for each pixel of its light's own standard deviation along that axis, in "
       "quadrature.",
       from_to(0, 1)},
      {"sigma_per_cut_spread", &lamps.sigma_per_cut_spread,
       "Standard deviation of the middle of a lamp as thin as a pixel, which the threshold cuts in places, for each "
       "pixel "
       "of its light's own; thicker lamps lose less.",
       from_to(0, 1)},
  };
}

}  // namespace

Section lamps_section(LampSettings& lamps) {
  return {"lamps", "Lamps in the images of the front end \"lamps\".",
          joined({light_keys(lamps), shape_keys(lamps), noise_keys(lamps)})};
}

}  // namespace azimuth
