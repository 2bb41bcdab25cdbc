#pragma once
// Covariance ellipses and the strength with which they are drawn.

#include <Eigen/Core>
#include <vector>

namespace azimuth {

/// A point with its covariance.
struct UncertainPoint {
  Eigen::Vector2d p_map_m = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Zero();
};

inline constexpr double kDrawnSigmas = 2.0;

/// Semi-major axis of the ellipse of kDrawnSigmas [m]; infinite if the covariance is not finite.
double semi_major_m(const UncertainPoint& point);

/// Polygon approximation of the ellipse of kDrawnSigmas in the map frame.
std::vector<Eigen::Vector2d> ellipse_outline_m(const UncertainPoint& point);

/// Opacity factor of an ellipse in a view whose shorter side has length `view_m`. It is 1 up to a diameter of a tenth
/// of the view, decreases for larger ellipses so that all need about the same ink, and is 0 if the diameter exceeds the
/// view.
double ellipse_ink(double semi_major_m, double view_m);

}  // namespace azimuth
