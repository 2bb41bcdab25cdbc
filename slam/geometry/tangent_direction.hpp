#pragma once
// A measured direction, and the residual of a predicted direction, without a singularity at the zenith.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <optional>

namespace azimuth {

/// A measured direction, with the tangent plane of the unit sphere at it. The plane's two axes, across (towards growing
/// azimuth) and along (away from the zenith), have independent errors. Near the zenith, where azimuths are ill-defined,
/// the error across remains as small as the pixel's.
///
/// A lamp is given by m, its horizontal offset from the camera per metre of height.
class TangentDirection {
 public:
  /// The direction is in the robot's frame. `variance_rad2` is the variance of (azimuth, zenith angle) [rad^2].
  TangentDirection(double azimuth_rad, double zenith_rad, const Eigen::Vector2d& variance_rad2)
      : towards_(std::sin(zenith_rad) * std::cos(azimuth_rad), std::sin(zenith_rad) * std::sin(azimuth_rad),
                 std::cos(zenith_rad)),
        across_(-std::sin(azimuth_rad), std::cos(azimuth_rad), 0.0),
        along_(std::cos(zenith_rad) * std::cos(azimuth_rad), std::cos(zenith_rad) * std::sin(azimuth_rad),
               -std::sin(zenith_rad)),
        variance_(std::pow(std::sin(zenith_rad), 2) * variance_rad2.x(), variance_rad2.y()) {}

  /// Variance of (across, along) [rad^2].
  const Eigen::Vector2d& variance() const { return variance_; }
  /// Adds variance of (across, along) [rad^2].
  void add_variance(const Eigen::Vector2d& variance_rad2) { variance_ += variance_rad2; }
  double zenith_cosine() const { return towards_.z(); }
  double zenith_sine() const { return towards_.head<2>().norm(); }
  /// m of the measured direction, which must be above the horizon.
  Eigen::Vector2d offset_per_metre() const { return towards_.head<2>() / towards_.z(); }
  /// d(offset per metre) / d(across, along).
  Eigen::Matrix2d offset_by_error() const {
    Eigen::Matrix2d by_error;
    by_error.col(0) = across_.head<2>() / towards_.z();
    by_error.col(1) = along_.head<2>() / towards_.z() - along_.z() * towards_.head<2>() / (towards_.z() * towards_.z());
    return by_error;
  }

  /// Measured minus predicted direction, in the tangent plane.
  struct Residual {
    Eigen::Vector2d innovation;  ///< (across, along) [rad, for small ones]
    Eigen::Matrix2d by_offset;   ///< d(prediction) / dm
    Eigen::RowVector2d stretch;  ///< d(log of the length of (m, 1) along the measured direction) / dm
  };
  /// Residual of a lamp predicted at m; empty when the prediction is a right angle or more away.
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
