#pragma once
// Computes the pose of a differential drive from the distances its wheels have rolled.

#include <cmath>
#include <optional>

#include "slam/geometry/pose2.hpp"

namespace azimuth {

/// Dimensions of the wheels; 0 if not given.
struct Wheels {
  double radius_m = 0.0;  ///< radius of both wheels, to convert angles to distances
  double track_m = 0.0;   ///< distance between the contact points of the wheels
};

/// Integrates arcs of constant curvature between readings. Thread contract: thread-bound.
class WheelPath {
 public:
  explicit WheelPath(double track_m) : track_m_(track_m) {}

  /// The pose after both wheels have rolled the given total distances. The first call defines the origin.
  Pose2 at(double left_m, double right_m) {
    const double left = begun_ ? left_m - left_m_ : 0.0, right = begun_ ? right_m - right_m_ : 0.0;
    begun_ = true;
    drive(0.5 * (left + right), (right - left) / track_m_);
    left_m_ = left_m;
    right_m_ = right_m;
    return T_odom_body_;
  }

  /// The pose after an arc of the given length and turn.
  Pose2 drive(double length_m, double turned_rad) {
    const double half_rad = 0.5 * turned_rad;
    const double along_m = length_m * (std::abs(half_rad) < 1e-9 ? 1.0 : std::sin(half_rad) / half_rad);
    T_odom_body_.x_m += along_m * std::cos(T_odom_body_.heading_rad + half_rad);
    T_odom_body_.y_m += along_m * std::sin(T_odom_body_.heading_rad + half_rad);
    T_odom_body_.heading_rad = wrap(T_odom_body_.heading_rad + turned_rad);
    return T_odom_body_;
  }

 private:
  double track_m_;
  bool begun_ = false;
  double left_m_ = 0.0, right_m_ = 0.0;
  Pose2 T_odom_body_;
};

/// The heading of a rotation that is nearly about the vertical. Nothing if the length of the quaternion differs from 1
/// by more than a hundredth.
inline std::optional<double> heading_of(double qx, double qy, double qz, double qw) {
  const double length = std::sqrt(qx * qx + qy * qy + qz * qz + qw * qw);
  if (!(std::abs(length - 1.0) < 0.01)) return std::nullopt;
  return wrap(std::atan2(2.0 * (qw * qz + qx * qy), qw * qw + qx * qx - qy * qy - qz * qz));
}

}  // namespace azimuth
