#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>

#include "slam/camera/camera_rig.hpp"
#include "slam/camera/camera_tilt.hpp"
#include "slam/camera/image_axes.hpp"
#include "slam/camera/radial_profiles.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {

/// Number of lens parameters that a fit estimates: image centre (2), polynomial coefficients (4) and azimuth offset
/// (1). The polynomial has no linear term, since a smooth lens has none.
inline constexpr int kLensNumbers = 7;
using LensVector = Eigen::Matrix<double, kLensNumbers, 1>;
using LensCovariance = Eigen::Matrix<double, kLensNumbers, kLensNumbers>;

/// The polynomial fisheye (slam/camera/radial_profiles.hpp) with radii in units of `radius_px`, so that all
/// coefficients have a similar size:
///
///   rho Z + F(rho) d = 0,  F(rho) = c0 + c2 rho^2 + c3 rho^3 + c4 rho^4,  r = radius_px rho
///
/// for a point at horizontal distance d and height Z from the viewpoint. If Z and all c are multiplied by the same
/// number, the image does not change: images alone cannot separate heights from focal lengths (mathematics VI.28).
///
/// Thread contract: reentrant.
struct Lens {
  ImageAxes axes;
  std::array<double, 4> c{};  ///< c0, c2, c3, c4
  double radius_px = 1.0;
  CameraTilt tilt{};  ///< tilt of the camera; d and Z above refer to the camera's own axis

  /// The image of (X, Y, Z) in the robot's axes with origin at the viewpoint: x ahead, y to the left, z up. `about_px`
  /// is the initial radius of the search. Nothing if no radius near it fits.
  struct Image {
    Pixel pixel = Pixel::Zero();
    Eigen::Matrix<double, 2, 3> by_point;
    Eigen::Matrix<double, 2, kLensNumbers> by_lens;  ///< u0, v0, c0, c2, c3, c4, offset of the azimuth
    Eigen::Matrix2d by_tilt;                         ///< roll, pitch
  };
  std::optional<Image> image(const Eigen::Vector3d& point_m, double about_px) const;

  /// The point (X, Y) on a plane `height_m` above the viewpoint that a pixel shows. Nothing at or below the horizon.
  std::optional<Eigen::Vector2d> on_plane(const Pixel& pixel, double height_m) const;

  /// Viewing ray of a pixel; its length is arbitrary.
  Eigen::Vector3d ray(const Pixel& pixel) const;

  double theta_rad(double radius_px) const;

  LensVector numbers() const;  ///< all parameters except the tilt
  Lens moved(const LensVector& by) const;

  std::array<double, PolynomialFisheye::kCoefficients> coefficients() const;  ///< for radii in pixels

 private:
  std::optional<Image> image_in_camera(const Eigen::Vector3d& point_m, double about_px) const;
};

/// The lens of a rig whose camera looks up. `unit_px` is the largest radius of interest. The polynomial approximates
/// other camera models up to that radius. If the rig describes no valid camera, the result is empty and `problem` has
/// the reason.
std::optional<Lens> lens_of(const CameraRig& rig, double unit_px, std::string& problem);

/// Image radius of a direction `theta_rad` from the axis; NaN if it has no image.
double radius_px(const Lens& lens, double theta_rad);
/// Standard deviation of radius_px() due to the polynomial coefficients.
double sigma_radius_px(const Lens& lens, const LensCovariance& covariance, double theta_rad);

/// The largest angle up to `wanted_rad` for which theta grows with the radius.
double theta_max_rad(const Lens& lens, double wanted_rad);

/// The smaller of half the image's smaller side and the outer radius of the mask; 0 if neither is known.
double image_radius_px(const ImageRig& image);

/// The rig with its lens replaced by `lens`, valid up to `theta_max_rad` from the axis.
CameraRig with_lens(CameraRig rig, const Lens& lens, double theta_max_rad);

}  // namespace azimuth
