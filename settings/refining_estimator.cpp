#include "settings/refining_estimator.hpp"

#include <fmt/format.h>
#include <utility>

#include "settings/configured_estimator.hpp"
#include "slam/estimator/mounted_estimator.hpp"
#include "slam/hindsight/make_smoother_estimator.hpp"

namespace azimuth {
namespace {

/// As configured, but for which estimator, and for only finding the robot in its map.
Configuration changed_for(const Rig& rig, const Configuration& configuration) {
  Configuration changed = configuration;
  changed.estimator = refined_by(rig, configuration) == RefinedBy::filter ? "by_rig" : "smoother";
  changed.map.mode = MapMode::extend;
  return changed;
}

}  // namespace

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
                       refining_estimator_name(rig, configuration));
  return fmt::format("everything at once; which bearing is of which landmark, estimator \"{}\" has decided",
                     refining_estimator_name(rig, configuration));
}

std::string_view refining_estimator_name(const Rig& rig, const Configuration& configuration) {
  return estimator_name(rig, changed_for(rig, configuration));
}

std::unique_ptr<Estimator> refining_estimator(const Rig& rig, const Configuration& configuration,
                                              const MapSnapshot* map) {
  return mounted(rig.camera, map, [&](const MapSnapshot* seen_map) {
    return refining_estimator_of_viewpoint(rig, configuration, seen_map);
  });
}

std::unique_ptr<Estimator> refining_estimator_of_viewpoint(const Rig& rig, const Configuration& configuration,
                                                           const MapSnapshot* map) {
  auto estimator = estimator_of_viewpoint(rig, changed_for(rig, configuration), map);
  if (refined_by(rig, configuration) != RefinedBy::filter) return estimator;
  return make_with_hindsight(std::move(estimator), rig, configuration.smoother);
}

std::optional<std::string_view> why_unfit_to_refine(const MapSnapshot& map, const Rig& rig,
                                                    const Configuration& configuration) {
  if (refined_by(rig, configuration) == RefinedBy::filter)
    return "landmarks known by their looks are mapped anew from this drive alone";
  return why_unfit(map, rig, changed_for(rig, configuration));
}

}  // namespace azimuth
