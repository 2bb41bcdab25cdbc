#pragma once
// A direction that was measured, and how far another one is off it: without a singularity at the zenith.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <optional>

namespace azimuth {

/// A direction as measured, with a plane that touches the unit sphere there. Two axes of that plane, across (towards
/// growing azimuth) and along (away from the zenith), carry independent errors; near the zenith, where azimuths mean
/// little, the error across stays as finite as the pixel's.
class TangentDirection {
 public:
  /// In the robot's frame. `variance` of (azimuth, zenith angle) [rad^2].
  TangentDirection(double azimuth_rad, double zenith_rad, const Eigen::Vector2d& variance_rad2)
      : towards_(std::sin(zenith_rad) * std::cos(azimuth_rad), std::sin(zenith_rad) * std::sin(azimuth_rad),
                 std::cos(zenith_rad)),
        across_(-std::sin(azimuth_rad), std::cos(azimuth_rad), 0.0),
        along_(std::cos(zenith_rad) * std::cos(azimuth_rad), std::cos(zenith_rad) * std::sin(azimuth_rad),
               -std::sin(zenith_rad)),
        variance_(std::pow(std::sin(zenith_rad), 2) * variance_rad2.x(), variance_rad2.y()) {}

  /// Of (across, along) [rad^2].
  const Eigen::Vector2d& variance() const { return variance_; }
  /// What else makes it uncertain, likewise.
  void add_variance(const Eigen::Vector2d& variance_rad2) { variance_ += variance_rad2; }
  double zenith_cosine() const { return towards_.z(); }
  double zenith_sine() const { return towards_.head<2>().norm(); }
  /// m of this very direction; it must be above the horizon.
  Eigen::Vector2d offset_per_metre() const { return towards_.head<2>() / towards_.z(); }
  /// d(offset per metre) / d(across, along).
  Eigen::Matrix2d offset_by_error() const {
    Eigen::Matrix2d by_error;
    by_error.col(0) = across_.head<2>() / towards_.z();
    by_error.col(1) = along_.head<2>() / towards_.z() - along_.z() * towards_.head<2>() / (towards_.z() * towards_.z());
    return by_error;
  }

  /// Measured minus predicted, in the plane.
  struct Residual {
    Eigen::Vector2d innovation;  ///< (across, along) [rad, for small ones]
    Eigen::Matrix2d by_offset;   ///< d(prediction) / dm
    Eigen::RowVector2d stretch;  ///< d(log of the length of (m, 1) along the measured direction) / dm
  };
  /// Of a lamp predicted at m; nothing when that is a right angle away or more.
  /* M = (m, 1), t = towards . M: prediction = (across . M, along . M) / t */
  std::optional<Residual> against(const Eigen::Vector2d& m) const {
    const Eigen::Vector3d M(m.x(), m.y(), 1.0);
    const double t = towards_.dot(M);
    if (!(t > 0.0)) return std::nullopt;
    const Eigen::Vector2d predicted = Eigen::Vector2d(across_.dot(M), along_.dot(M)) / t;
    Residual residual;
    residual.innovation = -predicted;
    residual.by_offset.row(0) = (across_.head<2>() - predicted.x() * towards_.head<2>()).transpose() / t;
    residual.stretch = towards_.head<2>().transpose() / t;
    residual.by_offset.row(1) = (along_.head<2>() - predicted.y() * towards_.head<2>()).transpose() / t;
    return residual;
  }

 private:
  Eigen::Vector3d towards_, across_, along_;  // unit vectors of the robot's frame, z up
  Eigen::Vector2d variance_;
};

}  // namespace azimuth
