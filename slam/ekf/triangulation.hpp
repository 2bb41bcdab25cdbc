#pragma once
// Delayed initialisation: the landmark at the intersection of two bearings (mathematics I.8, eq 34 to 41 corrected),
// and how well a Gaussian describes it (mathematics I.9).

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "slam/geometry/pose2.hpp"

namespace azimuth {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Matrix26d = Eigen::Matrix<double, 2, 6>;
using Vector8d = Eigen::Matrix<double, 8, 1>;

/// A bearing: the pose it was taken from, and the azimuth relative to that pose's heading.
struct Sighting {
  Pose2 T_map_body;
  double azimuth_rad;
};

/// The intersection of two rays, with derivatives.
struct Intersection {
  Eigen::Vector2d p_map_landmark_m;   ///< eq 35
  Matrix26d by_poses;                 ///< G = [G_vi G_vj], eq 39 and 40 corrected
  Eigen::Matrix2d by_azimuths;        ///< W = [w_i w_j], eq 41
  double sine;                        ///< D = sin(alpha_i - alpha_j), sine of the parallax
  double distance_i_m, distance_j_m;  ///< Ray parameters; negative: behind the robot

  /// Whether the point is in front of both robots and the rays are not parallel.
  bool valid() const;
};

/// The intersection of two lines of sight. Nothing when they are exactly parallel.
std::optional<Intersection> intersect(const Sighting& i, const Sighting& j);

/// P_LL = G P6 G^T + sigma^2 W W^T: covariance of the new landmark; `P6` is the joint covariance of both poses.
Eigen::Matrix2d landmark_covariance(const Intersection& intersection, const Matrix6d& P6, double sigma_rad);

/// The lower Cholesky factor of a positive semi-definite matrix. A pivot below 1e-12 of the largest diagonal element
/// gives a zero column (clones and the first pose make P6 singular).
Matrix6d semidefinite_cholesky(const Matrix6d& P6);

/// The relative entropy between the true density of (pose i, pose j, landmark) and the Gaussian of the linearised
/// transform, in the exact reduced form of mathematics I.9, over a fixed set of standard normal samples.
///
/// The value is small when the landmark is well described by its mean and covariance. It depends on the number of
/// samples, so a threshold is valid for one number only. Infinity when the intersection is not valid() at the mean.
///
/// Thread contract: immutable after construction; any thread.
class QualityTest {
 public:
  explicit QualityTest(int samples);

  double relative_entropy(const Sighting& i, const Sighting& j, const Matrix6d& P6, double sigma_rad) const;

  /// The terms whose mean is the relative entropy, for the first `count` samples; for tests.
  std::vector<double> terms(const Sighting& i, const Sighting& j, const Matrix6d& P6, double sigma_rad,
                            int count) const;

 private:
  std::vector<Vector8d> samples_;
};

}  // namespace azimuth
