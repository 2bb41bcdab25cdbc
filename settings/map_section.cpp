#include <numbers>

#include "settings/configuration_sections.hpp"

namespace azimuth {

Section map_section(MapStart& start) {
  return {"map",
          "Starting from a saved map, where there is one (daemon.map.file, azimuth replay --map).",
          {everyday(choice<MapMode>(
               "mode", start.mode, {{"extend", MapMode::extend}, {"localise", MapMode::localise}},
               "extend: go on mapping; localise: keep the map as it is, and only find the robot in it.")),
           everyday({"pose_known", &start.pose_known,
                     "The robot is about where the map saw it last; else it may be anywhere and is looked for first."}),
           everyday({"sigma_position_m", &start.sigma_position_m,
                     "Pose known: standard deviation of how far the robot may have been moved since, along each axis.",
                     from_to(0, 100)}),
           everyday({"sigma_heading_rad", &start.sigma_heading_rad,
                     "Pose known: standard deviation of how far the robot may have been turned since.",
                     from_to(0, std::numbers::pi)}),
           everyday({"reach_m", &start.reach_m,
                     "Pose not known: how far from where the map saw the robot last it can be. 0: anywhere, but a "
                     "daemon that was "
                     "restarted a moment ago knows how far that can be at most (daemon.map.recent_s).",
                     from_to(0, 1e6)})}};
}

}  // namespace azimuth
