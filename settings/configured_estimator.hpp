#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
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

/// Source of the data association when a whole drive is refined afterwards.
enum class RefinedBy : std::uint8_t {
  names,       ///< the names that bearings carry
  hypotheses,  ///< association hypotheses that explain all bearings best, since all landmarks look alike
  filter,      ///< the rig's filter associates once, by the landmarks' looks; path and map are then refined
};

RefinedBy refined_by(const Rig& rig, const Configuration& configuration);

/// Returns a sentence, for a person, that says how the drive is refined.
std::string how_refined(const Rig& rig, const Configuration& configuration);

/// The kind of the refining estimator: the smoother, or the filter for the rig, whichever estimator is configured.
EstimatorKind chosen_refining_estimator(const Rig& rig, const Configuration& configuration);

/// Makes the estimator that refines a whole drive. The caller must call Estimator::conclude() at the end of the drive.
/// The estimator starts from `map`, if given, and improves it.
std::unique_ptr<Estimator> refining_estimator(const Rig& rig, const Configuration& configuration,
                                              const MapSnapshot* map = nullptr);

/// Makes the filter for the rig, with a smoother that refines the filter's path and map during the drive. The camera is
/// at the robot's origin, see estimator_at_viewpoint().
std::unique_ptr<Estimator> filter_with_hindsight(const Rig& rig, const Configuration& configuration,
                                                 const MapSnapshot* map = nullptr);

/// Returns why refining cannot start from `map`, or nothing if it can.
std::optional<std::string_view> why_unfit_to_refine(const MapSnapshot& map, const Rig& rig,
                                                    const Configuration& configuration);

}  // namespace azimuth
