#pragma once
// Lens, lamps and path of a drive in one least-squares fit: bundle adjustment with odometry (SPEC VI.28).

#include <cstddef>
#include <optional>
#include <vector>

#include "slam/geometry/motion.hpp"
#include "tools/lens_fit/lens.hpp"

namespace azimuth {

/// A lamp in an image.
struct LampObservation {
  std::size_t frame = 0, lamp = 0;
  Pixel pixel = Pixel::Zero();
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Identity();
};

/// All that the fit is made of.
struct LensDrive {
  std::vector<Motion> motions;  ///< one a frame, from the frame before; that of the first one is not used
  std::vector<LampObservation> sightings;
};

/// What is known beforehand. Standard deviations.
struct LensPriors {
  /// Of the lamps above the viewpoint. Nothing: nobody measured it, so c0, the lens's scale, stays as it is and the
  /// height is what is found.
  std::optional<double> lamp_height_m;
  double sigma_lamp_height_m = 0.02;
  double sigma_one_lamp_m = 0.02;  ///< of one lamp about the height of all
  double sigma_scale_distance = 0.01, sigma_scale_turn = 0.01;
  CameraTilt tilt{};
  double sigma_tilt_rad = 0.0;  ///< 0: the tilt is known, and stays
};

/// The numbers that hold throughout: those of the lens, then
inline constexpr int kLampHeight = kLensNumbers;        ///< above the viewpoint [m]
inline constexpr int kScaleDistance = kLampHeight + 1;  ///< relative error of the odometry's distances
inline constexpr int kScaleTurn = kScaleDistance + 1;   ///< likewise of its turns
inline constexpr int kRoll = kScaleTurn + 1;            ///< of the lens's tilt
inline constexpr int kPitch = kRoll + 1;
inline constexpr int kThroughout = kPitch + 1;
using Throughout = Eigen::Matrix<double, kThroughout, 1>;

struct LensSolution {
  Lens lens;
  double lamp_height_m = 0.0;
  double scale_distance_error = 0.0, scale_turn_error = 0.0;
  std::vector<Pose2> T_map_body;       ///< of each frame; the first one is the origin
  std::vector<Eigen::Vector3d> lamps;  ///< x, y in the map, and height above lamp_height_m

  // Filled by fit_lens().
  Eigen::Matrix<double, kThroughout, kThroughout> covariance = Eigen::Matrix<double, kThroughout, kThroughout>::Zero();
  double unit_variance = 1.0;  ///< by how much the sightings' errors exceed what was claimed; in the covariance already
  std::vector<double> error_px;  ///< of each sighting; NaN: the lens has no image of it
  std::vector<bool> fits;        ///< whether it counts in full, more or less

  LensCovariance of_lens() const { return covariance.topLeftCorner<kLensNumbers, kLensNumbers>(); }
  double rms_px() const;   ///< of what fits, as distances in the image
  double fitting() const;  ///< share of the sightings
};

/// Fits from `start`, by Gauss and Newton, damped, with Cauchy's kernel on sightings. Nothing: what is there does not
/// determine the unknowns. Deterministic; thread contract: reentrant, allocates.
std::optional<LensSolution> fit_lens(const LensDrive& drive, const LensSolution& start, const LensPriors& priors);

}  // namespace azimuth
