#pragma once
// Estimates lens, lamps and path of a drive in one least-squares fit: bundle adjustment with odometry (mathematics
// VI.28).

#include <cstddef>
#include <optional>
#include <vector>

#include "slam/geometry/motion.hpp"
#include "tools/lens_fit/lens.hpp"
#include "tools/lens_fit/robust_fit.hpp"

namespace azimuth {

/// Observation of a lamp in an image.
struct LampObservation {
  std::size_t frame = 0, lamp = 0;
  Pixel pixel = Pixel::Zero();
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Identity();
};

/// Measurements for the fit.
struct LensDrive {
  std::vector<Motion> motions;  ///< one per frame, from the previous frame; the first one is not used
  std::vector<LampObservation> sightings;
};

/// Prior values and their standard deviations.
struct LensPriors {
  /// Height of the lamps above the viewpoint. If nothing, the fit keeps c0, the scale of the lens, and estimates the
  /// height.
  std::optional<double> lamp_height_m;
  double sigma_lamp_height_m = 0.02;
  double sigma_one_lamp_m = 0.02;  ///< deviation of one lamp from the common height
  double sigma_scale_distance = 0.01, sigma_scale_turn = 0.01;
  CameraTilt tilt{};
  double sigma_tilt_rad = 0.0;  ///< 0 fixes the tilt
};

/// Indices of the global unknowns. The lens parameters come first, then:
inline constexpr int kLampHeight = kLensNumbers;        ///< height of the lamps above the viewpoint [m]
inline constexpr int kScaleDistance = kLampHeight + 1;  ///< relative error of the odometry's distances
inline constexpr int kScaleTurn = kScaleDistance + 1;   ///< relative error of the odometry's turns
inline constexpr int kRoll = kScaleTurn + 1;            ///< roll of the camera
inline constexpr int kPitch = kRoll + 1;
inline constexpr int kThroughout = kPitch + 1;

struct LensSolution {
  Lens lens;
  double lamp_height_m = 0.0;
  double scale_distance_error = 0.0, scale_turn_error = 0.0;
  std::vector<Pose2> T_map_body;       ///< pose at each frame; the first one is the origin
  std::vector<Eigen::Vector3d> lamps;  ///< x and y in the map, and height above lamp_height_m

  // Filled by fit_lens().
  Eigen::Matrix<double, kThroughout, kThroughout> covariance = Eigen::Matrix<double, kThroughout, kThroughout>::Zero();
  double unit_variance = 1.0;    ///< ratio of actual to stated observation variance; `covariance` includes it
  std::vector<double> error_px;  ///< residual of each observation; NaN if the lens has no image of the lamp
  std::vector<bool> fits;        ///< for each observation: whether its robust weight is at least one half

  LensCovariance of_lens() const { return covariance.topLeftCorner<kLensNumbers, kLensNumbers>(); }
  double rms_px() const;   ///< root mean square of the residuals that fit
  double fitting() const;  ///< share of the observations that fit
};

/// Fits from `start` with a damped Gauss-Newton method and the Cauchy kernel on observations. Nothing if the
/// measurements do not determine the unknowns. Deterministic. Thread contract: reentrant, allocates.
std::optional<LensSolution> fit_lens(const LensDrive& drive, const LensSolution& start, const LensPriors& priors);

// Only fit_lens() and the test of its Jacobian use the following.

/// Unknowns: the kThroughout global numbers, then (x, y, heading) of each frame, then (x, y, height) of each lamp.
using LensEquations = FitEquations;

LensEquations lens_equations(const LensDrive& drive, const LensSolution& at, const LensSolution& start,
                             const LensPriors& priors);
LensSolution lens_moved(LensSolution from, const Eigen::VectorXd& by);

}  // namespace azimuth
