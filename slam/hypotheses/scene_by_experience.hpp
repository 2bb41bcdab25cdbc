#pragma once
#include <span>

#include "slam/hypotheses/scene.hpp"
#include "slam/smoother/bearing_graph.hpp"

namespace azimuth {

/// The full angle about the heading in which bearings come: of the given one, as much as is not unlikely (5 %) never to
/// have been used. A camera that is said to see all round may be mounted where it does not, and landmarks behind it
/// would count as missed. Thread contract: reentrant.
double field_of_view_by_experience(double given_rad, const BearingGraph& graph);

/// What is believed of the range.
struct RangeBelief {
  double range_m = 0.0;
  double doubt = 0.0;  ///< see Scene::range_doubt
};
/// How far landmarks are seen, from which of `landmarks` were seen where and which were not, before and after as well
/// (SPEC VI.20). Where nothing was seen come or go by its distance it is the given one, with the given doubt: a robot
/// that has only been in a small room cannot know. Thread contract: reentrant.
RangeBelief range_by_experience(const Scene& given, const BearingGraph& graph, std::span<const LandmarkId> landmarks);

/// Both. Through a narrow view, where landmarks come and go by its edges, the range is as given.
Scene scene_by_experience(const Scene& given, const BearingGraph& graph, std::span<const LandmarkId> landmarks);

}  // namespace azimuth
