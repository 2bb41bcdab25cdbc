#pragma once
#include "slam/smoother/bearing_graph.hpp"

namespace azimuth {

/// The full angle about the heading in which bearings come: of the given one, as much as is not unlikely (5 %) never to
/// have been used. A camera that is said to see all round may be mounted where it does not, and landmarks behind it
/// would count as missed. Thread contract: reentrant.
double field_of_view_by_experience(double given_rad, const BearingGraph& graph);

}  // namespace azimuth
