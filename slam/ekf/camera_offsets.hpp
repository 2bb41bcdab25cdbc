#pragma once
// What a camera that is other than its rig says does to azimuths (SPEC VI.34).
//
// With q = r (cos z, sin z) the pixel seen from the centre that was said, an axis at e sees p0 = q - e, and one that
// leans by (roll, pitch) has there what a level one would have at
//
//   p = p0 + l(|p0|) (pitch, -roll),   l(r) = r tan(elevation at r)
//
// up to the tilt squared; the azimuth is the angle of p. A tilt is an offset of the centre but for l, which is bounded:
// at the centre of a lens it is its focal length.

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "slam/camera/camera_model.hpp"
#include "slam/ekf/observation_row.hpp"

namespace azimuth {

/// As the camera should have shown it.
struct CentredPixel {
  Eigen::Vector2d p_px;
  Eigen::Matrix<double, 2, 4> by_camera;  ///< by CameraErrors::mean
};

/// Without a profile tilts do nothing. `errors` as CameraErrors::mean.
CentredPixel centred(double azimuth_rad, double radius_px, const Eigen::Vector4d& errors,
                     const std::optional<RadialProfile>& profile);

/// An azimuth with the camera's offsets taken out.
struct CorrectedAzimuth {
  double azimuth_rad;
  Eigen::RowVector4d by_camera;  ///< by CameraErrors::mean
};

/// How the camera differs from its description: constants, or blocks of the state.
struct CameraOffsets {
  static constexpr double kNearCentre_px = 2.0;  ///< nearer pixels say nothing of the azimuth

  double yaw_rad = 0.0;  ///< robot azimuth = camera azimuth + yaw; while there is no block for it
  std::optional<Index> yaw_block;
  std::optional<Index> errors_block;          ///< the centre's offset and, with a profile, the tilt behind it
  std::optional<RadialProfile> profile = {};  ///< from radius to elevation, of a camera whose tilt is unknown

  Index errors_size() const { return !errors_block ? 0 : profile ? 4 : 2; }

  /// `mean(entry)` gives the state.
  template <class Mean>
  Eigen::Vector4d errors(const Mean& mean) const {
    Eigen::Vector4d errors = Eigen::Vector4d::Zero();
    for (Index i = 0; i < errors_size(); ++i) errors(i) = mean(*errors_block + i);
    return errors;
  }

  /// A bearing without a radius does not care where the centre is.
  template <class Mean>
  CorrectedAzimuth correct(double azimuth_rad, double radius_px, const Mean& mean) const {
    const double turn_rad = yaw_block ? mean(*yaw_block) : yaw_rad;
    if (!errors_block || std::isnan(radius_px)) return {azimuth_rad + turn_rad, Eigen::RowVector4d::Zero()};
    const auto [p, by_camera] = centred(azimuth_rad, radius_px, errors(mean), profile);
    const double r2 = std::max(p.squaredNorm(), kNearCentre_px * kNearCentre_px);
    return {std::atan2(p.y(), p.x()) + turn_rad, Eigen::RowVector2d(-p.y() / r2, p.x() / r2) * by_camera};
  }
};

}  // namespace azimuth
