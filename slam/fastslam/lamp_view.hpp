#pragma once
// The measurement model of a lamp for a camera that looks up (mathematics II.2): z = (azimuth, zenith), where zenith is
// the angle from the optical axis.

#include <Eigen/Core>
#include <cmath>

#include "slam/fastslam/symmetric.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// The detection of one lamp in one image, with precomputed values that every particle needs.
struct LampSighting {
  double azimuth_rad = 0.0;  ///< Counter-clockwise from the robot's heading, in [-pi, pi)
  double zenith_rad = 0.0;   ///< From straight up, in [0, pi]
  Symmetric2 covariance;     ///< Q_l, of (azimuth, zenith) [rad^2]
  Identity identity = kUnknownIdentity;
  Both cosine{1.0, 1.0}, sine{0.0, 0.0};  ///< Of azimuth and zenith
  double log_peak = 0.0;                  ///< ln of the peak density of N(.; Q_l)

  double cos_azimuth() const { return cosine[0]; }
  double sin_azimuth() const { return sine[0]; }
  double cos_zenith() const { return cosine[1]; }
  double sin_zenith() const { return sine[1]; }
};
LampSighting make_sighting(double azimuth_rad, double zenith_rad, const Symmetric2& covariance,
                           Identity identity = kUnknownIdentity);

/// The camera's position in the map, and the heading with its sine and cosine.
struct Viewpoint {
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
  double heading_rad = 0.0, cos = 1.0, sin = 0.0;

  Viewpoint() = default;
  Viewpoint(const Eigen::Vector3d& pose, double height_m)
      : x_m(pose.x()),
        y_m(pose.y()),
        z_m(height_m),
        heading_rad(wrap(pose.z())),
        cos(std::cos(pose.z())),
        sin(std::sin(pose.z())) {}
  Viewpoint(const Pose2& T_map_body, double height_m) : Viewpoint(T_map_body.vector(), height_m) {}
  Eigen::Vector3d pose() const { return {x_m, y_m, heading_rad}; }
  Pose2 T_map_body() const { return {x_m, y_m, heading_rad}; }
};

/// The offset of a point from a viewpoint, and the derivatives of its direction:
///   H_x = [by_x, by_y, (-1, 0)] by (x, y, heading), H_m = [-by_x, -by_y, (0, by_z)] by the point
struct LampView {
  double dx_m = 0.0, dy_m = 0.0, dz_m = 0.0;
  double rho_m = 0.0;         ///< Horizontal distance
  double distance2_m2 = 0.0;  ///< Squared distance
  Both by_x{}, by_y{};        ///< Derivatives of azimuth and zenith by the pose's x and y [rad/m]
  double by_z = 0.0;          ///< Derivative of the zenith by the point's height [rad/m]

  TwoRows by_pose() const { return {by_x, by_y, Both{-1.0, 0.0}}; }
  TwoRows by_point() const { return {-by_x, -by_y, Both{0.0, by_z}}; }
  Eigen::Matrix<double, 2, 3> H_x() const { return by_pose().matrix(); }
  Eigen::Matrix<double, 2, 3> H_m() const { return by_point().matrix(); }
  /// H_x R H_x^T
  Symmetric2 of_pose(const Symmetric3& R) const { return quadratic(by_pose(), by_pose().times(R)); }
  /// H_m Sigma H_m^T
  Symmetric2 of_point(const Symmetric3& Sigma) const { return quadratic(by_point(), by_point().times(Sigma)); }
};

/// Least horizontal distance of the model. Straight below a lamp the azimuth is undefined.
inline constexpr double kNearestAxis_m = 1e-3;

/* h(m, x) = (wrap(atan2(dy, dx) - heading), atan2(rho, dz)), q = rho^2, D2 = q + dz^2:
 *   H_x = [ dy/q, -dx/q, -1;  -dz dx/(rho D2), -dz dy/(rho D2), 0 ]
 *   H_m = [-dy/q,  dx/q,  0;   dz dx/(rho D2),  dz dy/(rho D2), -rho/D2 ]
 */
inline LampView view(const Viewpoint& from, const Eigen::Vector3d& p_map) {
  LampView v;
  v.dx_m = p_map.x() - from.x_m;
  v.dy_m = p_map.y() - from.y_m;
  v.dz_m = p_map.z() - from.z_m;
  v.rho_m = std::max(std::sqrt(v.dx_m * v.dx_m + v.dy_m * v.dy_m), kNearestAxis_m);
  const double q = v.rho_m * v.rho_m;
  v.distance2_m2 = q + v.dz_m * v.dz_m;
  const double over_q = 1.0 / q, over_D2 = 1.0 / v.distance2_m2, steep = v.dz_m * over_D2 / v.rho_m;
  v.by_x = Both{over_q, -steep} * Both{v.dy_m, v.dx_m};
  v.by_y = -Both{over_q, steep} * Both{v.dx_m, v.dy_m};
  v.by_z = -v.rho_m * over_D2;
  return v;
}

/// Whether a point at this horizontal distance and height above the camera has at most the zenith angle of the given
/// cosine; needs no square root.
inline bool is_within_zenith(double horizontal2_m2, double dz_m, double cos_max_zenith) {
  const auto signed_square = [](double value) { return value * std::abs(value); };
  return signed_square(dz_m) >= signed_square(cos_max_zenith) * (horizontal2_m2 + dz_m * dz_m);
}

/// (azimuth, zenith) of the point.
Eigen::Vector2d direction_of(const LampView& view, double heading_rad);

/// Element-wise atan2(sine, cosine), with a short series for small angles, which most innovations are.
inline Eigen::Vector2d small_atan2(const Both& sine, const Both& cosine) {
  const Both t = sine / cosine, u = t * t;
  const auto is_small = [&](int i) { return cosine[i] > 0.0 && std::abs(t[i]) < 0.1; };
  const auto angle = [&](int i, const Both& small) { return is_small(i) ? small[i] : std::atan2(sine[i], cosine[i]); };
  // The first omitted term is below 1e-17.
  const Both small =
      t * (1.0 - u * (1.0 / 3.0 -
                      u * (1.0 / 5.0 -
                           u * (1.0 / 7.0 -
                                u * (1.0 / 9.0 - u * (1.0 / 11.0 - u * (1.0 / 13.0 - u * (1.0 / 15.0 - u / 17.0))))))));
  return {angle(0, small), angle(1, small)};
}

/// The deviation of a detected from a predicted direction, as lengths. They rule out most pairs, so that angles are
/// computed only for the remaining ones.
struct Offset {
  /// Element 0: horizontal distance times sine (across) and cosine (along) of the azimuth's innovation. Element 1:
  /// distance times sine and cosine of the zenith's innovation.
  Both across_m, along_m;

  Eigen::Vector2d innovation() const { return small_atan2(across_m, along_m); }
};
inline Offset offset(const LampView& view, const Viewpoint& from, const LampSighting& seen) {
  const double ahead = view.dx_m * from.cos + view.dy_m * from.sin, left = view.dy_m * from.cos - view.dx_m * from.sin;
  const Both along{ahead, view.dz_m}, across{left, view.rho_m};
  return {along * seen.sine - across * seen.cosine, along * seen.cosine + across * seen.sine};
}
/// wrap(z - h(m, x))
inline Eigen::Vector2d innovation(const LampView& view, const Viewpoint& from, const LampSighting& seen) {
  return offset(view, from, seen).innovation();
}

/// nu^T S^-1 nu
inline double squared_distance(const Eigen::Vector2d& nu, const Symmetric2& S) {
  return (S.yy * nu.x() * nu.x() - 2.0 * S.xy * nu.x() * nu.y() + S.xx * nu.y() * nu.y()) / S.determinant();
}
/// ln N(nu; 0, S)
inline double log_normal(const Eigen::Vector2d& nu, const Symmetric2& S) {
  return -0.5 * (squared_distance(nu, S) + std::log(4.0 * kPi * kPi * S.determinant()));
}

}  // namespace azimuth
