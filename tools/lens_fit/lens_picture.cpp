#include "tools/lens_fit/lens_picture.hpp"

namespace azimuth {

PlotCanvas lens_picture(const ImageView& image, const LensDrive& drive, const LensSolution& solution) {
  std::vector<Residual> residuals;
  for (std::size_t i = 0; i < drive.sightings.size(); ++i) {
    const LampObservation& sighting = drive.sightings[i];
    const Eigen::Vector3d& lamp = solution.lamps[sighting.lamp];
    Eigen::Vector3d point;
    point << inverse(solution.T_map_body[sighting.frame]) * Eigen::Vector2d(lamp.head<2>()),
        solution.lamp_height_m + lamp.z();
    const auto expected = solution.lens.image(point, solution.lens.axes.polar(sighting.pixel).radius_px);
    if (expected) residuals.push_back({sighting.pixel, expected->pixel, solution.fits[i]});
  }
  return residual_picture(image, solution.lens, residuals, solution.rms_px());
}

}  // namespace azimuth
