#include "settings/configured_estimator.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "slam/ceiling/make_lamp_ekf_estimator.hpp"
#include "slam/estimator/mounted_estimator.hpp"
#include "slam/estimator/start_from_map.hpp"
#include "slam/particles/make_fastslam_estimator.hpp"
#include "slam/planar/make_ekf_estimator.hpp"

namespace azimuth {
namespace {

/// Returns the configuration with the refining estimator, which always extends the map.
Configuration refining(const Rig& rig, const Configuration& configuration) {
  Configuration changed = configuration;
  changed.estimator =
      refined_by(rig, configuration) == RefinedBy::filter ? EstimatorKind::by_rig : EstimatorKind::smoother;
  changed.map.mode = MapMode::extend;
  return changed;
}

/// Whether the landmarks differ in kind, so that a search can tell places apart.
bool has_several_kinds(const MapSnapshot& map) {
  return std::ranges::any_of(map.landmarks,
                             [&](const MapLandmark& landmark) { return landmark.kind != map.landmarks.front().kind; });
}

/// Whether the pose must be found among landmarks without names. Only the EKF can find it, by the landmarks' kinds.
bool wants_a_search(const MapSnapshot& map, const Configuration& configuration) {
  return map.names == MapNames::none && !configuration.map.pose_known && has_several_kinds(map);
}

/// Whether by_rig takes the smoother: it measured best with ready-made bearings, with names or without. Only the filter
/// can keep a map as it is, and only the filter follows the papers' presets.
bool suits_the_smoother(const Rig& rig, const Configuration& configuration, const MapSnapshot* map) {
  if (map != nullptr && wants_a_search(*map, configuration)) return false;
  return rig.front_end == FrontEnd::bearings && configuration.preset == Preset::recommended &&
         configuration.map.mode == MapMode::extend;
}

}  // namespace

bool sees_a_ceiling(const Rig& rig) {
  return rig.front_end == FrontEnd::lamps || (rig.front_end == FrontEnd::bearings && looks_up(rig.camera.model));
}

EstimatorKind chosen_estimator(const Rig& rig, const Configuration& configuration, const MapSnapshot* map) {
  if (configuration.estimator != EstimatorKind::by_rig) return configuration.estimator;
  if (sees_a_ceiling(rig)) return EstimatorKind::lamp_ekf;
  return suits_the_smoother(rig, configuration, map) ? EstimatorKind::smoother : EstimatorKind::ekf;
}

std::unique_ptr<Estimator> configured_estimator(const Rig& rig, const Configuration& configuration,
                                                const MapSnapshot* map, const Helpers& helpers) {
  return mounted(rig.camera, map, [&](const MapSnapshot* seen_map) {
    return estimator_at_viewpoint(rig, configuration, seen_map, helpers);
  });
}

std::unique_ptr<Estimator> estimator_at_viewpoint(const Rig& rig, const Configuration& configuration,
                                                  const MapSnapshot* map, const Helpers& helpers) {
  MapStart start = configuration.map;
  start.map = map;
  const HealthSettings& health = configuration.health;
  const RelocalisationSettings& relocalisation = configuration.relocalisation;
  switch (chosen_estimator(rig, configuration, map)) {
    case EstimatorKind::fastslam:
      return make_fastslam_estimator(rig, configuration.fastslam, start, health, relocalisation);
    case EstimatorKind::lamp_ekf:
      return make_lamp_ekf_estimator(rig, configuration.lamp_ekf, start, health, relocalisation);
    case EstimatorKind::smoother:
      if (refined_by(rig, configuration) == RefinedBy::filter) return filter_with_hindsight(rig, configuration, map);
      return make_smoother_estimator(rig, configuration.smoother, start, health, relocalisation, helpers);
    case EstimatorKind::ekf:
    case EstimatorKind::by_rig:  // chosen_estimator() never returns it
      break;
  }
  return make_ekf_estimator(rig, configuration.ekf, start, health, relocalisation);
}

std::optional<std::string_view> why_unfit(const MapSnapshot& map, const Rig& rig, const Configuration& configuration) {
  const EstimatorKind chosen = chosen_estimator(rig, configuration, &map);
  if (chosen == EstimatorKind::fastslam) return why_unfit_for_fastslam(map, rig, configuration.fastslam);
  if (chosen == EstimatorKind::lamp_ekf) return why_unfit_for_lamp_ekf(map, rig);
  if (chosen == EstimatorKind::smoother)
    return why_unfit_for_smoother(map, rig, configuration.smoother, configuration.map);
  const bool can_search = configuration.relocalisation.lost_log_odds > 0.0 && has_several_kinds(map);
  if (map.names == MapNames::none && !can_search && !configuration.map.pose_known) return kPoseIsNeeded;
  return why_unfit_for_ekf(map, rig);
}

RefinedBy refined_by(const Rig& rig, const Configuration& configuration) {
  if (sees_a_ceiling(rig)) return RefinedBy::filter;
  if (rig.camera.identities && configuration.smoother.names) return RefinedBy::names;
  return rig.front_end == FrontEnd::bearings ? RefinedBy::hypotheses : RefinedBy::filter;
}

std::string how_refined(const Rig& rig, const Configuration& configuration) {
  switch (refined_by(rig, configuration)) {
    case RefinedBy::names:
      return "everything at once; which bearing is of which landmark, its name says";
    case RefinedBy::hypotheses:
      return "everything at once; which bearing is of which landmark is what explains all of them best";
    case RefinedBy::filter:
      break;
  }
  if (sees_a_ceiling(rig))
    return fmt::format("the path at once; which bearing is of which lamp, and the map, estimator \"{}\" has decided",
                       name(chosen_refining_estimator(rig, configuration)));
  return fmt::format("everything at once; which bearing is of which landmark, estimator \"{}\" has decided",
                     name(chosen_refining_estimator(rig, configuration)));
}

EstimatorKind chosen_refining_estimator(const Rig& rig, const Configuration& configuration) {
  return chosen_estimator(rig, refining(rig, configuration));
}

std::unique_ptr<Estimator> refining_estimator(const Rig& rig, const Configuration& configuration,
                                              const MapSnapshot* map) {
  return mounted(rig.camera, map, [&](const MapSnapshot* seen_map) {
    if (refined_by(rig, configuration) == RefinedBy::filter) return filter_with_hindsight(rig, configuration, seen_map);
    return estimator_at_viewpoint(rig, refining(rig, configuration), seen_map);
  });
}

std::unique_ptr<Estimator> filter_with_hindsight(const Rig& rig, const Configuration& configuration,
                                                 const MapSnapshot* map) {
  auto filter = estimator_at_viewpoint(rig, refining(rig, configuration), map);
  return make_with_hindsight(std::move(filter), rig, configuration.smoother);
}

std::optional<std::string_view> why_unfit_to_refine(const MapSnapshot& map, const Rig& rig,
                                                    const Configuration& configuration) {
  if (refined_by(rig, configuration) == RefinedBy::filter)
    return "landmarks known by their looks are mapped anew from this drive alone";
  return why_unfit(map, rig, refining(rig, configuration));
}

}  // namespace azimuth
