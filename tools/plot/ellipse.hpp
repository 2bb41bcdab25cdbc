#pragma once
// Ellipses of uncertain points, and how much of them is worth drawing.

#include <Eigen/Core>
#include <vector>

namespace azimuth {

/// A point with its covariance.
struct UncertainPoint {
  Eigen::Vector2d p_map_m = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Zero();
};

inline constexpr double kDrawnSigmas = 2.0;

/// Half the longest diameter of its ellipse of kDrawnSigmas [m]; infinite where the covariance is no number.
double semi_major_m(const UncertainPoint& point);

/// Corners of that ellipse in the map.
std::vector<Eigen::Vector2d> ellipse_outline_m(const UncertainPoint& point);

/// How strongly an ellipse is drawn in a view whose shorter side is `view_m` long: fully (1) up to a tenth of the view
/// from end to end, fainter the larger it is, so that all of them need about the same ink, and not at all (0) where it
/// is larger than the view.
double ellipse_ink(double semi_major_m, double view_m);

}  // namespace azimuth
