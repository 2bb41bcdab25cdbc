#pragma once
#include <Eigen/Core>
#include <optional>
#include <string_view>
#include <variant>

#include "slam/camera/camera_tilt.hpp"
#include "slam/camera/image_axes.hpp"
#include "slam/camera/radial_profiles.hpp"

namespace azimuth {

using RadialProfile =
    std::variant<HyperbolicMirror, ParabolicMirror, PajdlaFisheye, EquidistantFisheye, PolynomialFisheye>;

/// A direction from the camera's viewpoint, in the robot's frame.
struct Direction {
  /// Counter-clockwise from the heading, in [-pi, pi); arbitrary for the zenith and the nadir.
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;  ///< Up from the horizontal, in [-pi/2, pi/2]
};

/// The unit vector along `direction`: x ahead, y to the left, z up.
Eigen::Vector3d ray(const Direction& direction);
/// The direction of a non-zero vector.
Direction direction(const Eigen::Vector3d& ray);

/// An omnidirectional camera with a single viewpoint and an optical axis that is vertical or has a known tilt. Converts
/// pixels to directions in the robot's frame, which is level, and back. The two conversions are inverse to each other
/// wherever both are defined.
///
/// Thread contract: reentrant. Nothing allocates.
class CameraModel {
 public:
  /// The reason why these parameters are not valid; nullopt if they are valid.
  static std::optional<std::string_view> problem(const ImageAxes& axes, const RadialProfile& profile);

  /// problem() must return nullopt for these parameters.
  CameraModel(const ImageAxes& axes, const RadialProfile& profile, const CameraTilt& tilt = {});

  /// Returns nullopt for pixels outside the image circle of the lens or mirror. ImageMask, not this class, knows hidden
  /// and cut-off parts of the image.
  std::optional<Direction> direction(const Pixel& pixel) const;
  std::optional<Eigen::Vector3d> ray(const Pixel& pixel) const;

  /// Returns nullopt for directions that the camera cannot see. `ray` must not be zero; its length does not matter.
  std::optional<Pixel> pixel(const Direction& direction) const;
  std::optional<Pixel> pixel(const Eigen::Vector3d& ray) const;

  /// d (azimuth, elevation) / d (u, v), defined where direction() is. Within ImageAxes::kNearCentre_px of the image of
  /// the zenith or nadir, the azimuth's row is that at this distance, since it would otherwise grow without bound.
  std::optional<Eigen::Matrix2d> direction_jacobian(const Pixel& pixel) const;
  /// Covariance of (azimuth, elevation) [rad^2] of a detection with standard deviation `sigma_px` along u and along v.
  std::optional<Eigen::Matrix2d> direction_covariance(const Pixel& pixel, double sigma_px) const;

  /// Applies the tilt: converts a direction in the frame of the tilted camera to the level robot frame.
  Direction levelled(const Direction& in_camera) const;
  /// The same camera without its tilt.
  CameraModel upright() const { return {axes_, profile_}; }
  /// level_pixel() gives the pixel at which the untilted camera would see the direction that this camera sees at
  /// `pixel`; tilted_pixel() is the inverse. Without a tilt, both return their argument. In the levelled image the
  /// sides of upright objects are lines through the centre. Returns nullopt for pixels outside either image.
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
