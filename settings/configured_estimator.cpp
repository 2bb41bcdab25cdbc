#include "settings/configured_estimator.hpp"

#include <algorithm>

#include "settings/refining_estimator.hpp"
#include "slam/ceiling/make_lamp_ekf_estimator.hpp"
#include "slam/estimator/map_fitness.hpp"
#include "slam/estimator/mounted_estimator.hpp"
#include "slam/particles/make_fastslam_estimator.hpp"
#include "slam/planar/make_ekf_estimator.hpp"

namespace azimuth {
namespace {

/// Looks by which a search can tell places apart.
bool has_several_kinds(const MapSnapshot& map) {
  return std::ranges::any_of(map.landmarks,
                             [&](const MapLandmark& landmark) { return landmark.kind != map.landmarks.front().kind; });
}

/// Where among landmarks without names the robot is, only the filter finds out, by their kinds.
bool wants_a_search(const MapSnapshot& map, const Configuration& configuration) {
  return map.names == MapNames::none && !configuration.map.pose_known && has_several_kinds(map);
}

/// Ready-made bearings, with names or without: there it measured best. A map that stays as it is, and the paper's
/// values, are the filter's.
bool suits_the_smoother(const Rig& rig, const Configuration& configuration, const MapSnapshot* map) {
  if (map != nullptr && wants_a_search(*map, configuration)) return false;
  return rig.front_end == FrontEnd::bearings && configuration.preset == Preset::recommended &&
         configuration.map.mode == MapMode::extend;
}

}  // namespace

bool sees_a_ceiling(const Rig& rig) {
  return rig.front_end == FrontEnd::lamps || (rig.front_end == FrontEnd::bearings && looks_up(rig.camera.model));
}

std::string_view estimator_name(const Rig& rig, const Configuration& configuration, const MapSnapshot* map) {
  for (const std::string_view name : {"ekf", "lamp_ekf", "fastslam", "smoother"})
    if (configuration.estimator == name) return name;
  if (sees_a_ceiling(rig)) return "lamp_ekf";
  return suits_the_smoother(rig, configuration, map) ? "smoother" : "ekf";
}

std::unique_ptr<Estimator> configured_estimator(const Rig& rig, const Configuration& configuration,
                                                const MapSnapshot* map, const Helpers& helpers) {
  return mounted(rig.camera, map, [&](const MapSnapshot* seen_map) {
    return estimator_of_viewpoint(rig, configuration, seen_map, helpers);
  });
}

std::unique_ptr<Estimator> estimator_of_viewpoint(const Rig& rig, const Configuration& configuration,
                                                  const MapSnapshot* map, const Helpers& helpers) {
  const std::string_view name = estimator_name(rig, configuration, map);
  MapStart start = configuration.map;
  start.map = map;
  if (name == "fastslam")
    return make_fastslam_estimator(rig, configuration.fastslam, configuration.health, start,
                                   configuration.ekf.relocalisation);
  if (name == "lamp_ekf") {
    LampEkfSettings lamp_ekf = configuration.lamp_ekf;
    lamp_ekf.health = configuration.health;
    return make_lamp_ekf_estimator(rig, lamp_ekf, start, configuration.ekf.relocalisation);
  }
  if (name == "smoother" && refined_by(rig, configuration) == RefinedBy::filter)
    return refining_estimator_of_viewpoint(rig, configuration, map);
  if (name == "smoother")
    return make_smoother_estimator(rig, configuration.smoother, start, configuration.health,
                                   configuration.ekf.relocalisation, helpers);
  EkfSettings ekf = configuration.ekf;
  ekf.health = configuration.health;
  return make_ekf_estimator(rig, ekf, start);
}

std::optional<std::string_view> why_unfit(const MapSnapshot& map, const Rig& rig, const Configuration& configuration) {
  const std::string_view name = estimator_name(rig, configuration, &map);
  if (name == "fastslam") return why_unfit_for_fastslam(map, rig, configuration.fastslam);
  if (name == "lamp_ekf") return why_unfit_for_lamp_ekf(map, rig);
  if (name == "smoother") return why_unfit_for_smoother(map, rig, configuration.smoother, configuration.map);
  const bool can_search = configuration.ekf.relocalisation.lost_log_odds > 0.0 && has_several_kinds(map);
  if (map.names == MapNames::none && !can_search && !configuration.map.pose_known) return kPoseIsNeeded;
  return why_unfit_for_ekf(map, rig);
}

}  // namespace azimuth
