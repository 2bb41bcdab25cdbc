#include "tools/plot/ellipse.hpp"

#include <cmath>
#include <limits>

#include "slam/geometry/angle.hpp"
#include "slam/geometry/principal_axes.hpp"

namespace azimuth {
namespace {

/// The matrix that maps the unit circle to the ellipse about the origin.
Eigen::Matrix2d half_axes_m(const Eigen::Matrix2d& covariance_m2) {
  const PrincipalAxes axes = principal_axes(covariance_m2);
  return axes.directions * axes.eigenvalues.cwiseMax(0.0).cwiseSqrt().asDiagonal() * kDrawnSigmas;
}

}  // namespace

double semi_major_m(const UncertainPoint& point) {
  if (!point.covariance_m2.allFinite()) return std::numeric_limits<double>::infinity();
  return half_axes_m(point.covariance_m2).colwise().norm().maxCoeff();
}

std::vector<Eigen::Vector2d> ellipse_outline_m(const UncertainPoint& point) {
  constexpr int kCorners = 48;
  const Eigen::Matrix2d half_axes = half_axes_m(point.covariance_m2);
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * kPi * i / kCorners;
    corners.emplace_back(point.p_map_m + half_axes * Eigen::Vector2d{std::cos(angle), std::sin(angle)});
  }
  return corners;
}

double ellipse_ink(double semi_major_m, double view_m) {
  constexpr double kFull = 0.05, kGone = 0.5;  // semi-major axis as a fraction of the view
  const double share = semi_major_m / view_m;
  if (!(share <= kGone)) return 0.0;
  return share <= kFull ? 1.0 : kFull / share;
}

}  // namespace azimuth
