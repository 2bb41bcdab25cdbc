#include "slam/hypotheses/scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace azimuth {
namespace {

const double kSqrtTwoPi = std::sqrt(2.0 * std::numbers::pi);
// Lower bound of a cost, since a hypothesis may be wrong even about clear odds.
constexpr double kLeastCost = 0.1;

}  // namespace

bool Scene::sees_all_round() const { return field_of_view_rad > 2.0 * std::numbers::pi - 1e-6; }

double Scene::images_for_all_round() const {
  return sees_all_round() ? 1.0 : 2.0 * std::numbers::pi / field_of_view_rad;
}

bool Scene::in_view(double azimuth_rad) const {
  return sees_all_round() || std::abs(std::remainder(azimuth_rad, 2.0 * std::numbers::pi)) <= 0.5 * field_of_view_rad;
}

/// A bearing of a landmark has the density p_D N(r; sigma^2), clutter has lambda_c. The cost of an unassigned bearing
/// is ln of their ratio at r = 0. A landmark has a prior density lambda_n by direction and N(rho_0, sigma_0^2) by
/// inverse distance. Its bearings reduce this to standard deviations of about sigma by direction and sigma rho_0 by
/// inverse distance, for a parallax of about a radian (Laplace's approximation of the evidence).
HypothesisCosts hypothesis_costs(const Scene& scene, const SmootherSettings& smoother) {
  const double sigma = scene.sigma_bearing_rad, rho_0 = smoother.inverse_depth_mean_per_m;
  HypothesisCosts costs;
  costs.unassigned = std::log(scene.detection_probability / (kSqrtTwoPi * sigma * scene.clutter_per_rad));
  costs.landmark =
      -std::log(kSqrtTwoPi * scene.new_per_rad * sigma * (sigma * rho_0) / smoother.inverse_depth_sigma_per_m);
  costs.missed = -std::log1p(-scene.detection_probability);
  costs.unassigned = std::max(costs.unassigned, kLeastCost);
  costs.landmark = std::max(costs.landmark, kLeastCost);
  return costs;
}

}  // namespace azimuth
