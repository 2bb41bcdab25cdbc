#pragma once
#include <memory>
#include <string>
#include <string_view>

#include "settings/configuration.hpp"
#include "slam/estimator/estimator.hpp"
#include "slam/estimator/rig.hpp"

namespace azimuth {

/// Who decides, where a whole drive is worked out afterwards, which bearing is of which landmark.
enum class RefinedBy : std::uint8_t {
  names,       ///< the sensor does
  hypotheses,  ///< nobody: landmarks are all alike, so path and map do
  filter,      ///< landmarks have looks: the estimator for them does, once, and path and map follow
};

RefinedBy refined_by(const Rig& rig, const Configuration& configuration);

/// How that is done, for a person.
std::string how_refined(const Rig& rig, const Configuration& configuration);

/// Its name: "smoother", or that of the filter for the rig. Which estimator was configured does not matter.
std::string_view refining_estimator_name(const Rig& rig, const Configuration& configuration);

/// What works out a whole drive, and is to be told that it is over (Estimator::conclude()). It starts from `map`, if
/// there is one, and makes it better.
std::unique_ptr<Estimator> refining_estimator(const Rig& rig, const Configuration& configuration,
                                              const MapSnapshot* map = nullptr);

/// Likewise of the camera's viewpoint in the robot's place: what MountedEstimator makes one of the robot.
std::unique_ptr<Estimator> refining_estimator_of_viewpoint(const Rig& rig, const Configuration& configuration,
                                                           const MapSnapshot* map = nullptr);

/// Why it cannot start from `map`; nothing: it can.
std::optional<std::string_view> why_unfit_to_refine(const MapSnapshot& map, const Rig& rig,
                                                    const Configuration& configuration);

}  // namespace azimuth
