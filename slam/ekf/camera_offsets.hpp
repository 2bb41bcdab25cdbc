#pragma once
// Effect on azimuths of a camera that differs from its rig (mathematics VI.34).
//
// Let q = r (cos z, sin z) be the pixel relative to the rig's centre. If the centre is off by e, the pixel relative to
// the true centre is p0 = q - e. If the camera leans by (roll, pitch), a level camera would show the direction at
//
//   p = p0 + l(|p0|) (pitch, -roll),   l(r) = r tan(elevation at r)
//
// to first order in the tilt. The azimuth is the angle of p. A tilt acts like an offset of the centre, scaled by l,
// which is bounded: at the centre of a lens it is its focal length.

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "slam/camera/camera_model.hpp"
#include "slam/ekf/observation_row.hpp"

namespace azimuth {

/// A pixel as a camera without these errors would show it.
struct CentredPixel {
  Eigen::Vector2d p_px;
  Eigen::Matrix<double, 2, 4> by_camera;  ///< Derivative by CameraErrors::mean
};

/// Without a profile the tilt has no effect. `errors` is laid out as CameraErrors::mean.
CentredPixel centred(double azimuth_rad, double radius_px, const Eigen::Vector4d& errors,
                     const std::optional<RadialProfile>& profile);

/// An azimuth corrected for the camera's offsets.
struct CorrectedAzimuth {
  double azimuth_rad;
  Eigen::RowVector4d by_camera;  ///< Derivative by CameraErrors::mean
};

/// How the camera differs from its rig: constants, or blocks of the state.
struct CameraOffsets {
  static constexpr double kNearCentre_px = 2.0;  ///< Pixels nearer to the centre carry no information on the azimuth

  double yaw_rad = 0.0;  ///< Robot azimuth = camera azimuth + yaw; used while there is no yaw_block
  std::optional<Index> yaw_block;
  std::optional<Index> errors_block;          ///< The centre's offset, followed by the tilt if there is a profile
  std::optional<RadialProfile> profile = {};  ///< Radius to elevation; set if the tilt is estimated

  Index errors_size() const { return !errors_block ? 0 : profile ? 4 : 2; }

  /// `mean(entry)` returns an entry of the state.
  template <class Mean>
  Eigen::Vector4d errors(const Mean& mean) const {
    Eigen::Vector4d errors = Eigen::Vector4d::Zero();
    for (Index i = 0; i < errors_size(); ++i) errors(i) = mean(*errors_block + i);
    return errors;
  }

  /// A bearing without a radius does not depend on the centre.
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
