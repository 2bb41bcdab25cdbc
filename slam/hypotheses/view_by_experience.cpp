#include "slam/hypotheses/view_by_experience.hpp"

#include <algorithm>
#include <cmath>

namespace azimuth {

/// Of n directions within +-a the widest is below a 0.05^(1/n) in 5 % of all cases.
double field_of_view_by_experience(double given_rad, const BearingGraph& graph) {
  constexpr double kUnlikely = 0.05;
  constexpr int kFewestToJudgeBy = 20;
  if (graph.bearings() < kFewestToJudgeBy) return given_rad;
  double widest_rad = 0.0;
  for (BearingId id = 0; id < graph.bearings(); ++id)
    widest_rad = std::max(widest_rad, std::abs(graph.bearing(id).azimuth_rad));
  const double n = graph.bearings();
  return std::min(given_rad, 2.0 * widest_rad * std::pow(kUnlikely, -1.0 / n));
}

}  // namespace azimuth
