#include <numbers>

#include "settings/configuration_sections.hpp"

namespace azimuth {

Section health_section(HealthSettings& health) {
  const Range heading_rad = above_to(0, std::numbers::pi);
  return {
      "health",
      "When an estimate counts as degraded or lost, whatever estimator runs.",
      {everyday({"degraded_after_m", &health.degraded_after_m,
                 "Degraded: driven this far without recognising a landmark.", above_to(0, 100000)}),
       everyday(
           {"degraded_sigma_m", &health.degraded_sigma_m,
            "Degraded: the position's standard deviation is above this; 0: above a hundredth of the map's reach (the "
            "distance of its farthest landmark from where it began), and at least 0.5 m.",
            from_to(0, 1000)}),
       everyday({"degraded_sigma_heading_rad", &health.degraded_sigma_heading_rad,
                 "Degraded: the heading's standard deviation is above this.", heading_rad}),
       {"degraded_centre_px", &health.degraded_centre_px,
        "Degraded: the image's centre is off by more than this, which calls for a calibration; 0: never.",
        from_to(0, 1000)},
       {"degraded_tilt_rad", &health.degraded_tilt_rad,
        "Degraded: the camera surely leans by more than this otherwise than the rig says, which calls for a "
        "calibration; 0: never.",
        from_to(0, 1)},
       {"degraded_lag_s", &health.degraded_lag_s,
        "Degraded: images and odometry are surely farther apart in time than this, which calls for a calibration; "
        "0: never.",
        from_to(0, 10)},
       everyday({"lost_sigma_m", &health.lost_sigma_m,
                 "Lost: the position's standard deviation is above this; 0: above a fifth of the map's reach, "
                 "5 m at least and 50 m at most.",
                 from_to(0, 1000)}),
       everyday({"lost_sigma_heading_rad", &health.lost_sigma_heading_rad,
                 "Lost: the heading's standard deviation is above this.", heading_rad})}};
}

}  // namespace azimuth
