#pragma once
#include <span>

#include "slam/hypotheses/scene.hpp"
#include "slam/smoother/bearing_graph.hpp"

namespace azimuth {

/// The field of view (full angle about the heading) learned from the azimuths of the bearings so far. It is the largest
/// angle, up to `given_rad`, for which the absence of bearings beyond the widest one has a probability of at least 5 %.
/// A camera that should see all round may be mounted where it does not, and landmarks behind it would count as missed.
/// Thread contract: reentrant.
double field_of_view_by_experience(double given_rad, const BearingGraph& graph);

/// Estimate of the detection range.
struct RangeBelief {
  double range_m = 0.0;
  double doubt = 0.0;  ///< see Scene::range_doubt
};
/// The detection range learned from the distances at which `landmarks` were seen and were missed, from shortly before
/// their first to shortly after their last bearing (mathematics VI.20). Without landmarks that come into or go out of
/// range, the range and its doubt stay as given: a robot in a small room cannot learn the range. Thread contract:
/// reentrant.
RangeBelief range_by_experience(const Scene& given, const BearingGraph& graph, std::span<const LandmarkId> landmarks);

/// The scene with the learned field of view and range. Through a narrow view, landmarks come and go at the edges of the
/// view, and the range stays as given.
Scene scene_by_experience(const Scene& given, const BearingGraph& graph, std::span<const LandmarkId> landmarks);

}  // namespace azimuth
