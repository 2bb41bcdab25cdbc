#include "settings/refining_estimator.hpp"

#include <fmt/format.h>
#include <utility>

#include "settings/configured_estimator.hpp"
#include "slam/estimator/mounted_estimator.hpp"
#include "slam/hindsight/make_smoother_estimator.hpp"

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
