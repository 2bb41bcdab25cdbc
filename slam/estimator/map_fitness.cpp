#include "slam/estimator/map_fitness.hpp"

namespace azimuth {

MapNames names_of(const Rig& rig) {
  if (rig.camera.identities) return MapNames::sensor;
  return rig.front_end == FrontEnd::sift ? MapNames::looks : MapNames::none;
}

std::string_view why_names_do_not_fit(const MapSnapshot& map, const Rig& rig) {
  if (map.names == names_of(rig)) return "";
  switch (map.names) {
    case MapNames::none:
      return "its landmarks have no names, and the rig's camera tells them apart by name or looks";
    case MapNames::sensor:
      return "its landmarks have names, which the rig's camera cannot read";
    case MapNames::looks:
      return "its landmarks are known by their looks, which the rig's front end does not see";
  }
  return "it is of a kind unknown here";
}

Eigen::Matrix3d moved_since(const MapStart& start) {
  return Eigen::Vector3d(start.sigma_position_m, start.sigma_position_m, start.sigma_heading_rad)
      .cwiseAbs2()
      .asDiagonal();
}

std::optional<Whereabouts> whereabouts(const MapStart& start) {
  if (start.reach_m <= 0.0) return std::nullopt;
  return Whereabouts{start.map->T_map_body.position(), start.reach_m};
}

}  // namespace azimuth
