#include "slam/estimator/start_from_map.hpp"

namespace azimuth {

MapNames names_of(const Rig& rig) {
  if (rig.camera.identities) return MapNames::sensor;
  return rig.front_end == FrontEnd::sift ? MapNames::looks : MapNames::none;
}

std::optional<std::string_view> why_names_do_not_fit(const MapSnapshot& map, const Rig& rig) {
  if (map.names == names_of(rig)) return std::nullopt;
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

StartPose start_pose(const MapStart& start) {
  StartPose pose;
  pose.known = start.pose_known;
  const Eigen::Vector3d sigmas(start.sigma_position_m, start.sigma_position_m, start.sigma_heading_rad);
  pose.moved = sigmas.cwiseAbs2().asDiagonal();
  if (start.reach_m > 0.0) pose.within = PositionPrior{start.map->T_map_body.position(), start.reach_m};
  return pose;
}

}  // namespace azimuth
