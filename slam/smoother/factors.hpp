#pragma once
// The measurement functions of odometry and bearings, with derivatives (mathematics VI.18).
//
// A pose moves by (d along its own axes, turn): p <- p + R(h) d, h <- h + turn. Derivatives are with respect to this
// step. The derivatives of odometry therefore depend only on the relative pose, and turning the whole map changes none
// of them.

#include <Eigen/Core>
#include <cmath>

#include "slam/geometry/motion.hpp"
#include "slam/geometry/pose2.hpp"

namespace azimuth {

/// A pose with the cosine and sine of its heading, which every factor needs.
struct SmoothedPose {
  Pose2 T_map_body;
  Eigen::Vector2d forwards{1.0, 0.0};  ///< (cos, sin) of the heading

  SmoothedPose() = default;
  explicit SmoothedPose(const Pose2& pose)
      : T_map_body(pose), forwards(std::cos(pose.heading_rad), std::sin(pose.heading_rad)) {}

  /// Turns a vector from the map's axes to the body's axes.
  Eigen::Vector2d to_body(const Eigen::Vector2d& v_map) const {
    return {forwards.x() * v_map.x() + forwards.y() * v_map.y(), forwards.x() * v_map.y() - forwards.y() * v_map.x()};
  }
  Eigen::Vector2d to_map(const Eigen::Vector2d& v_body) const {
    return {forwards.x() * v_body.x() - forwards.y() * v_body.y(),
            forwards.x() * v_body.y() + forwards.y() * v_body.x()};
  }
  SmoothedPose moved(const Eigen::Vector3d& step) const {
    const Eigen::Vector2d p = T_map_body.position() + to_map(step.head<2>());
    return SmoothedPose({p.x(), p.y(), wrap(T_map_body.heading_rad + step.z())});
  }
};

/// A landmark at c + u(alpha) / rho. The chart origin c is no unknown: it is the place from which the landmark was seen
/// first. rho <= 0 means at infinity or beyond, and is a valid value.
struct SmoothedLandmark {
  Eigen::Vector2d p_map_chart = Eigen::Vector2d::Zero();  ///< c
  double direction_rad = 0.0;                             ///< alpha, in the map
  double inverse_distance_per_m = 0.0;                    ///< rho
  Eigen::Vector2d direction{1.0, 0.0};                    ///< u(alpha)

  SmoothedLandmark() = default;
  SmoothedLandmark(const Eigen::Vector2d& p_map_chart_m, double alpha_rad, double rho_per_m)
      : p_map_chart(p_map_chart_m),
        direction_rad(wrap(alpha_rad)),
        inverse_distance_per_m(rho_per_m),
        direction(std::cos(alpha_rad), std::sin(alpha_rad)) {}

  SmoothedLandmark moved(const Eigen::Vector2d& step) const {
    return {p_map_chart, direction_rad + step.x(), inverse_distance_per_m + step.y()};
  }
  /// The same point, to first order, with the chart origin c moved by `shift_m`. When the landmark and its surroundings
  /// move together, the bearings as seen from the chart origin do not change.
  SmoothedLandmark seen_from(const Eigen::Vector2d& shift_m) const {
    const double rho = inverse_distance_per_m;
    const double across_m = direction.x() * shift_m.y() - direction.y() * shift_m.x();
    return {p_map_chart + shift_m, direction_rad - rho * across_m, rho + rho * rho * direction.dot(shift_m)};
  }
  /// Whether the landmark has a finite position.
  bool is_point() const { return inverse_distance_per_m > 0.0; }
  Eigen::Vector2d p_map() const { return p_map_chart + direction / inverse_distance_per_m; }
  /// d(p_map) / d(alpha, rho)
  Eigen::Matrix2d p_by_chart() const {
    const double distance_m = 1.0 / inverse_distance_per_m;
    Eigen::Matrix2d by_chart;
    by_chart << -distance_m * direction.y(), -distance_m * distance_m * direction.x(),  //
        distance_m * direction.x(), -distance_m * distance_m * direction.y();
    return by_chart;
  }
};

/// The predicted azimuth of a landmark, with derivatives.
struct SeenAzimuth {
  double azimuth_rad = 0.0;                               ///< from the heading, not wrapped
  Eigen::Vector3d by_pose = Eigen::Vector3d::Zero();      ///< by (along, left, turn)
  Eigen::Vector2d by_landmark = Eigen::Vector2d::Zero();  ///< by (alpha, rho)
};

/// Computes azimuth = atan2(B) - h with B = rho (c - p) + u(alpha). There is no division by rho, so rho = 0 needs no
/// special case. Returns false and leaves `out` unchanged when the landmark is nearer than `min_distance_m`, where the
/// model breaks down.
inline bool see(const SmoothedPose& pose, const SmoothedLandmark& landmark, double min_distance_m, SeenAzimuth& out) {
  const double rho = landmark.inverse_distance_per_m;
  const Eigen::Vector2d to_chart = landmark.p_map_chart - pose.T_map_body.position();
  const Eigen::Vector2d B = rho * to_chart + landmark.direction;
  const double square = B.squaredNorm();  // (rho * distance)^2
  const double nearest = min_distance_m * rho;
  if (!(square > nearest * nearest) || square < 1e-12) return false;
  const Eigen::Vector2d by_B(-B.y() / square, B.x() / square);
  const Eigen::Vector2d by_position = -rho * pose.to_body(by_B);
  out.azimuth_rad = std::atan2(B.y(), B.x()) - pose.T_map_body.heading_rad;
  out.by_pose = {by_position.x(), by_position.y(), -1.0};
  out.by_landmark = {landmark.direction.x() * by_B.y() - landmark.direction.y() * by_B.x(), by_B.dot(to_chart)};
  return true;
}

/// The predicted elevation of a landmark above the horizontal, with derivatives.
struct SeenElevation {
  double elevation_rad = 0.0;
  Eigen::Vector3d by_pose = Eigen::Vector3d::Zero();      ///< by (along, left, turn)
  Eigen::Vector2d by_landmark = Eigen::Vector2d::Zero();  ///< by (alpha, rho)
  double by_tangent = 0.0;
};

/// Computes tan(elevation) = tau / |B|, with B as in see(). `tangent` is tau = height * rho, the tangent of the
/// elevation as seen from the chart origin. Returns false and leaves `out` unchanged under the same condition as see().
inline bool see_height(const SmoothedPose& pose, const SmoothedLandmark& landmark, double tangent,
                       double min_distance_m, SeenElevation& out) {
  const double rho = landmark.inverse_distance_per_m;
  const Eigen::Vector2d to_chart = landmark.p_map_chart - pose.T_map_body.position();
  const Eigen::Vector2d B = rho * to_chart + landmark.direction;
  const double length = B.norm();  // rho * distance
  if (!(length > min_distance_m * std::abs(rho)) || length < 1e-6) return false;
  const double square = length * length + tangent * tangent;
  const Eigen::Vector2d by_B = -tangent / (square * length) * B;
  const Eigen::Vector2d by_position = -rho * pose.to_body(by_B);
  out.elevation_rad = std::atan2(tangent, length);
  out.by_pose = {by_position.x(), by_position.y(), 0.0};
  out.by_landmark = {landmark.direction.x() * by_B.y() - landmark.direction.y() * by_B.x(), by_B.dot(to_chart)};
  out.by_tangent = length / square;
  return true;
}

/// The end of a motion relative to its start, (along, left, turn), with derivatives.
struct SeenMotion {
  Eigen::Vector3d relative;
  Eigen::Matrix3d by_start, by_end;
};

inline Eigen::Vector3d relative_pose(const SmoothedPose& start, const SmoothedPose& end) {
  const Eigen::Vector2d along = start.to_body(end.T_map_body.position() - start.T_map_body.position());
  return {along.x(), along.y(), wrap(end.T_map_body.heading_rad - start.T_map_body.heading_rad)};
}

inline SeenMotion see_motion(const SmoothedPose& start, const SmoothedPose& end) {
  SeenMotion seen{relative_pose(start, end), {}, {}};
  const Eigen::Vector2d turned = start.to_body(end.forwards);  // (cos, sin) of the turn
  seen.by_start << -1.0, 0.0, seen.relative.y(),               //
      0.0, -1.0, -seen.relative.x(),                           //
      0.0, 0.0, -1.0;
  seen.by_end << turned.x(), -turned.y(), 0.0,  //
      turned.y(), turned.x(), 0.0,              //
      0.0, 0.0, 1.0;
  return seen;
}

}  // namespace azimuth
