#pragma once
#include <Eigen/Core>
#include <optional>
#include <string_view>
#include <variant>

#include "slam/camera/equidistant_fisheye.hpp"
#include "slam/camera/hyperbolic_mirror.hpp"
#include "slam/camera/image_axes.hpp"
#include "slam/camera/pajdla_fisheye.hpp"
#include "slam/camera/parabolic_mirror.hpp"
#include "slam/camera/polynomial_fisheye.hpp"

namespace azimuth {

using RadialProfile =
    std::variant<HyperbolicMirror, ParabolicMirror, PajdlaFisheye, EquidistantFisheye, PolynomialFisheye>;

/// Where something is seen from the camera's viewpoint, in the robot's frame.
struct Direction {
  double azimuth_rad = 0.0;    ///< counter-clockwise from the heading, [-pi, pi); arbitrary straight up and down
  double elevation_rad = 0.0;  ///< up from the horizontal, [-pi/2, pi/2]
};

/// The unit vector towards `direction`: x ahead, y to the left, z up.
Eigen::Vector3d ray(const Direction& direction);
/// The direction of any vector but zero.
Direction direction(const Eigen::Vector3d& ray);

/// An omnidirectional camera with one viewpoint and a vertical axis: pixels to directions in the robot's frame and
/// back. The two are inverse to each other wherever they give something.
///
/// Thread contract: reentrant. Nothing allocates.
class CameraModel {
 public:
  /// Why these parameters make no camera, if they do not.
  static std::optional<std::string_view> problem(const ImageAxes& axes, const RadialProfile& profile);

  /// Only parameters without a problem.
  CameraModel(const ImageAxes& axes, const RadialProfile& profile);

  /// Nothing for pixels outside the image of the lens or the mirror. Where that image is hidden or cut off is the
  /// business of ImageMask.
  std::optional<Direction> direction(const Pixel& pixel) const;
  std::optional<Eigen::Vector3d> ray(const Pixel& pixel) const;

  /// Nothing for directions the camera cannot see. `ray` need not be of unit length, but not zero.
  std::optional<Pixel> pixel(const Direction& direction) const;
  std::optional<Pixel> pixel(const Eigen::Vector3d& ray) const;

  /// d (azimuth, elevation) / d (u, v) where direction() gives something. Within ImageAxes::kNearCentre_px of the
  /// centre the azimuth's row is that at this distance, since it would grow without bound.
  std::optional<Eigen::Matrix2d> direction_jacobian(const Pixel& pixel) const;
  /// Covariance of (azimuth, elevation) [rad^2] for a detection that is off by `sigma_px` along u and along v.
  std::optional<Eigen::Matrix2d> direction_covariance(const Pixel& pixel, double sigma_px) const;

  const ImageAxes& axes() const { return axes_; }
  const RadialProfile& profile() const { return profile_; }

 private:
  std::optional<ElevationAt> elevation_at(double radius_px) const;

  ImageAxes axes_;
  RadialProfile profile_;
};

}  // namespace azimuth
