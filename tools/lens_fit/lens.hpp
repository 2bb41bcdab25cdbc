#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>

#include "slam/camera/camera_rig.hpp"
#include "slam/camera/camera_tilt.hpp"
#include "slam/camera/image_axes.hpp"
#include "slam/camera/polynomial_fisheye.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {

/// What is looked for of a lens: where its axis meets the image, its polynomial without the linear term, which no
/// smooth lens has, and how it is turned about its axis.
inline constexpr int kLensNumbers = 7;
using LensVector = Eigen::Matrix<double, kLensNumbers, 1>;
using LensCovariance = Eigen::Matrix<double, kLensNumbers, kLensNumbers>;

/// The polynomial fisheye (slam/camera/polynomial_fisheye.hpp) with its radii in units of `radius_px`, in which its
/// coefficients are all about as large:
///
///   rho Z + F(rho) d = 0,  F(rho) = c0 + c2 rho^2 + c3 rho^3 + c4 rho^4,  r = radius_px rho
///
/// for what is d beside and Z above the viewpoint. Where Z and all c are multiplied by the same number, nothing in the
/// image changes: images alone do not tell heights from focal lengths (SPEC VI.28).
///
/// Thread contract: reentrant.
struct Lens {
  ImageAxes axes;
  std::array<double, 4> c{};  ///< c0, c2, c3, c4
  double radius_px = 1.0;
  CameraTilt tilt{};  ///< how it leans: d and Z above are those of the camera's own axis

  /// The image of (X, Y, Z) in the robot's frame, x ahead, y to the left, z up from the viewpoint; `about_px` is a
  /// radius near which it is. Nothing where no radius near it fits.
  struct Image {
    Pixel pixel = Pixel::Zero();
    Eigen::Matrix<double, 2, 3> by_point;
    Eigen::Matrix<double, 2, kLensNumbers> by_lens;  ///< u0, v0, c0, c2, c3, c4, offset of the azimuth
    Eigen::Matrix2d by_tilt;                         ///< roll, pitch
  };
  std::optional<Image> image(const Eigen::Vector3d& point_m, double about_px) const;

  /// Where a pixel looks: (X, Y) on a plane `height_m` above the viewpoint. Nothing at the horizon and below.
  std::optional<Eigen::Vector2d> on_plane(const Pixel& pixel, double height_m) const;

  /// Along which a pixel looks, of any length.
  Eigen::Vector3d ray(const Pixel& pixel) const;

  double theta_rad(double radius_px) const;

  LensVector numbers() const;  ///< but for the tilt
  Lens moved(const LensVector& by) const;

  std::array<double, PolynomialFisheye::kCoefficients> coefficients() const;  ///< of radii in pixels

 private:
  std::optional<Image> image_in_camera(const Eigen::Vector3d& point_m, double about_px) const;
};

/// The lens of a rig that looks up, whatever its model; `unit_px` is the largest radius of interest. Another model is
/// approached by the polynomial as well as can be up to there. Nothing, and why in `problem`, if it makes no camera.
std::optional<Lens> lens_of(const CameraRig& rig, double unit_px, std::string& problem);

/// The radius at which something is seen `theta_rad` from the axis; NaN: nowhere.
double radius_px(const Lens& lens, double theta_rad);
/// Its standard deviation, by all that is not known of the lens.
double sigma_radius_px(const Lens& lens, const LensCovariance& covariance, double theta_rad);

/// Up to `wanted_rad`, or as far as theta grows with the radius.
double theta_max_rad(const Lens& lens, double wanted_rad);

/// Half the image's smaller side, or to the rim of the mask where that is less; 0: neither is known.
double image_radius_px(const ImageRig& image);

/// The rig with this lens in place of its own, for directions up to `theta_max_rad`.
CameraRig with_lens(CameraRig rig, const Lens& lens, double theta_max_rad);

}  // namespace azimuth
