#pragma once
#include <memory>
#include <optional>
#include <string_view>

#include "settings/configuration.hpp"
#include "slam/estimator/estimator.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/hindsight/make_smoother_estimator.hpp"

namespace azimuth {

/// Whether the landmarks are lamps above the robot: the front end finds lamps in images, or a camera that looks up
/// sends ready-made bearings.
bool sees_a_ceiling(const Rig& rig);

/// The kind of the estimator that runs: the configured kind or, for by_rig, the kind that suits the rig and the map
/// that the estimator starts from. Never returns by_rig.
EstimatorKind chosen_estimator(const Rig& rig, const Configuration& configuration, const MapSnapshot* map = nullptr);

/// Makes the chosen estimator for a rig. The estimator starts from `map`, if given, as the table [map] says;
/// why_unfit() must accept the map. `helpers` are threads for an estimator that cannot compute everything between two
/// images.
std::unique_ptr<Estimator> configured_estimator(const Rig& rig, const Configuration& configuration,
                                                const MapSnapshot* map = nullptr, const Helpers& helpers = {});

/// Makes the same estimator for a camera at the robot's origin. MountedEstimator
/// transforms the estimator's poses to the robot.
std::unique_ptr<Estimator> estimator_at_viewpoint(const Rig& rig, const Configuration& configuration,
                                                  const MapSnapshot* map = nullptr, const Helpers& helpers = {});

/// Returns why the chosen estimator cannot start from `map`, or nothing if it can.
std::optional<std::string_view> why_unfit(const MapSnapshot& map, const Rig& rig, const Configuration& configuration);

}  // namespace azimuth
