#pragma once
#include <Eigen/Core>
#include <optional>
#include <string_view>

#include "slam/estimator/map_start.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/localisation/relocaliser.hpp"

namespace azimuth {

/// Who names landmarks on this rig.
MapNames names_of(const Rig& rig);

/// Why landmarks named as in `map` cannot be told apart on this rig; empty: they can.
std::string_view why_names_do_not_fit(const MapSnapshot& map, const Rig& rig);

/// How far the robot may have been moved since its map was saved: covariance of (x [m], y [m], heading [rad]).
Eigen::Matrix3d moved_since(const MapStart& start);

/// Where to look for a robot whose pose is not known; nothing: anywhere.
std::optional<Whereabouts> whereabouts(const MapStart& start);

}  // namespace azimuth
