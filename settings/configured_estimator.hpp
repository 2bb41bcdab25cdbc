#pragma once
#include <memory>
#include <optional>
#include <string_view>

#include "settings/configuration.hpp"
#include "slam/estimator/estimator.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/hindsight/make_smoother_estimator.hpp"

namespace azimuth {

/// Lamps above, found here or by whoever sends bearings of a camera that looks up.
bool sees_a_ceiling(const Rig& rig);

/// What runs: "ekf", "lamp_ekf", "fastslam" or "smoother"; the one that `configuration` names, or the one for the rig
/// and the map it starts from.
std::string_view estimator_name(const Rig& rig, const Configuration& configuration, const MapSnapshot* map = nullptr);

/// The estimator of that name, for a rig. It starts from `map`, if there is one, as the table [map] says; that must not
/// be unfit. `helpers` work for those that have more to do than an image leaves time for.
std::unique_ptr<Estimator> configured_estimator(const Rig& rig, const Configuration& configuration,
                                                const MapSnapshot* map = nullptr, const Helpers& helpers = {});

/// Likewise of the camera's viewpoint in the robot's place: what MountedEstimator makes one of the robot.
std::unique_ptr<Estimator> estimator_of_viewpoint(const Rig& rig, const Configuration& configuration,
                                                  const MapSnapshot* map = nullptr, const Helpers& helpers = {});

/// Why that estimator cannot start from `map`; nothing: it can.
std::optional<std::string_view> why_unfit(const MapSnapshot& map, const Rig& rig, const Configuration& configuration);

}  // namespace azimuth
