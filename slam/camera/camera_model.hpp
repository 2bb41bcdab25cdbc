#pragma once
#include <Eigen/Core>
#include <optional>
#include <string_view>
#include <variant>

#include "slam/camera/camera_tilt.hpp"
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

/// An omnidirectional camera with one viewpoint and an axis that is vertical, or leans by a known tilt: pixels to
/// directions in the robot's frame, which is level, and back. The two are inverse to each other wherever they give
/// something.
///
/// Thread contract: reentrant. Nothing allocates.
class CameraModel {
 public:
  /// Why these parameters make no camera, if they do not.
  static std::optional<std::string_view> problem(const ImageAxes& axes, const RadialProfile& profile);

  /// Only parameters without a problem.
  CameraModel(const ImageAxes& axes, const RadialProfile& profile, const CameraTilt& tilt = {});

  /// Nothing for pixels outside the image of the lens or the mirror. Where that image is hidden or cut off is the
  /// business of ImageMask.
  std::optional<Direction> direction(const Pixel& pixel) const;
  std::optional<Eigen::Vector3d> ray(const Pixel& pixel) const;

  /// Nothing for directions the camera cannot see. `ray` need not be of unit length, but not zero.
  std::optional<Pixel> pixel(const Direction& direction) const;
  std::optional<Pixel> pixel(const Eigen::Vector3d& ray) const;

  /// d (azimuth, elevation) / d (u, v) where direction() gives something. Within ImageAxes::kNearCentre_px of the
  /// image of the zenith, or of the nadir, the azimuth's row is that at this distance, since it would grow without
  /// bound.
  std::optional<Eigen::Matrix2d> direction_jacobian(const Pixel& pixel) const;
  /// Covariance of (azimuth, elevation) [rad^2] for a detection that is off by `sigma_px` along u and along v.
  std::optional<Eigen::Matrix2d> direction_covariance(const Pixel& pixel, double sigma_px) const;

  /// What `in_camera` is for the robot, of a direction from a camera that is taken to be level.
  Direction levelled(const Direction& in_camera) const;
  /// The same camera without its tilt.
  CameraModel upright() const { return {axes_, profile_}; }
  /// Where that would see what this one sees at `pixel`, and the inverse; a camera without tilt gives the pixel itself.
  /// In the levelled image the sides of upright things are lines through the centre. Nothing outside of either image.
  std::optional<Pixel> level_pixel(const Pixel& pixel) const;
  std::optional<Pixel> tilted_pixel(const Pixel& level_pixel) const;

  bool is_level() const { return tilt_.is_level(); }
  const CameraTilt& tilt() const { return tilt_; }
  const ImageAxes& axes() const { return axes_; }
  const RadialProfile& profile() const { return profile_; }

 private:
  std::optional<ElevationAt> elevation_at(double radius_px) const;
  std::optional<Direction> in_camera(const Pixel& pixel) const;
  std::optional<Pixel> pixel_in_camera(const Direction& in_camera) const;
  Eigen::Matrix2d levelled_jacobian(const Pixel& pixel, const ElevationAt& at) const;

  ImageAxes axes_;
  RadialProfile profile_;
  CameraTilt tilt_;
  Eigen::Matrix3d R_level_camera_ = Eigen::Matrix3d::Identity();
};

}  // namespace azimuth
