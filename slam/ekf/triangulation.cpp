#include "slam/ekf/triangulation.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/geometry/halton.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr double kParallelBelowSine = 1e-3;
constexpr double kRelativePivot = 1e-12;

/// Values shared by the terms of one quality test.
struct LinearisedIntersection {
  Sighting i, j;
  Intersection mean;
  Eigen::Matrix2d azimuths_by_landmark;  // W^-1
  double log_det_W;
  Matrix6d pose_factor;  // L with L L^T = P6
  double sigma_rad;
};

double log_det_by_azimuths(const Intersection& meeting) {
  return std::log(std::abs(meeting.distance_i_m * meeting.distance_j_m / meeting.sine));  // |det W| = r_i r_j / |D|
}

Sighting displaced(const Sighting& sighting, const Eigen::Vector3d& pose_error, double azimuth_error_rad) {
  const Pose2& T = sighting.T_map_body;
  return {{T.x_m + pose_error.x(), T.y_m + pose_error.y(), T.heading_rad + pose_error.z()},
          sighting.azimuth_rad + azimuth_error_rad};
}

/// ln w_k - ln v_k of one sample (mathematics I.9, "term_k").
double entropy_term(const LinearisedIntersection& at, const Vector8d& standard_normal) {
  const Eigen::Matrix<double, 6, 1> pose_error = at.pose_factor * standard_normal.head<6>();
  const Eigen::Vector2d azimuth_error = at.sigma_rad * standard_normal.tail<2>();
  const auto sample = intersect(displaced(at.i, pose_error.head<3>(), azimuth_error(0)),
                                displaced(at.j, pose_error.tail<3>(), azimuth_error(1)));
  if (!sample) return std::numeric_limits<double>::infinity();
  const Eigen::Vector2d residual = sample->p_map_landmark_m - at.mean.p_map_landmark_m - at.mean.by_poses * pose_error;
  const Eigen::Vector2d as_azimuths = at.azimuths_by_landmark * residual;
  const double variance = at.sigma_rad * at.sigma_rad;
  return (as_azimuths.squaredNorm() - azimuth_error.squaredNorm()) / (2.0 * variance) - log_det_by_azimuths(*sample) +
         at.log_det_W;
}

std::optional<LinearisedIntersection> linearise(const Sighting& i, const Sighting& j, const Matrix6d& P6,
                                                double sigma_rad) {
  const auto mean = intersect(i, j);
  if (!mean || !mean->valid()) return std::nullopt;
  return LinearisedIntersection{
      i, j, *mean, mean->by_azimuths.inverse(), log_det_by_azimuths(*mean), semidefinite_cholesky(P6), sigma_rad};
}

}  // namespace

bool Intersection::valid() const {
  return std::abs(sine) >= kParallelBelowSine && distance_i_m > 0.0 && distance_j_m > 0.0;
}

std::optional<Intersection> intersect(const Sighting& i, const Sighting& j) {
  const double alpha_i = i.T_map_body.heading_rad + i.azimuth_rad, alpha_j = j.T_map_body.heading_rad + j.azimuth_rad;
  const double si = std::sin(alpha_i), ci = std::cos(alpha_i), sj = std::sin(alpha_j), cj = std::cos(alpha_j);
  const double D = si * cj - sj * ci, t = D * D;
  if (D == 0.0) return std::nullopt;
  const double xi = i.T_map_body.x_m, yi = i.T_map_body.y_m, xj = j.T_map_body.x_m, yj = j.T_map_body.y_m;
  const double dx = xj - xi, dy = yj - yi;

  Intersection meeting;
  meeting.sine = D;
  meeting.p_map_landmark_m << (xi * si * cj - xj * sj * ci + dy * ci * cj) / D,  // eq 35
      (yj * si * cj - yi * sj * ci - dx * si * sj) / D;
  meeting.distance_i_m = (dy * cj - dx * sj) / D;
  meeting.distance_j_m = (dy * ci - dx * si) / D;
  const Eigen::Vector2d w_i((dx * sj * cj - dy * cj * cj) / t, (dx * sj * sj - dy * sj * cj) / t);  // eq 41
  const Eigen::Vector2d w_j((-dx * si * ci + dy * ci * ci) / t, (-dx * si * si + dy * si * ci) / t);
  meeting.by_azimuths << w_i, w_j;
  meeting.by_poses << si * cj / D, -ci * cj / D, w_i.x(), -sj * ci / D, ci * cj / D, w_j.x(),  // eq 39, eq 40 corrected
      si * sj / D, -sj * ci / D, w_i.y(), -si * sj / D, si * cj / D, w_j.y();
  return meeting;
}

Eigen::Matrix2d landmark_covariance(const Intersection& intersection, const Matrix6d& P6, double sigma_rad) {
  return intersection.by_poses * P6 * intersection.by_poses.transpose() +
         sigma_rad * sigma_rad * intersection.by_azimuths * intersection.by_azimuths.transpose();
}

Matrix6d semidefinite_cholesky(const Matrix6d& P6) {
  const double smallest = kRelativePivot * P6.diagonal().maxCoeff();
  Matrix6d L = Matrix6d::Zero();
  for (int c = 0; c < 6; ++c) {
    const double pivot = P6(c, c) - L.row(c).head(c).squaredNorm();
    if (pivot <= smallest) continue;
    L(c, c) = std::sqrt(pivot);
    for (int r = c + 1; r < 6; ++r) L(r, c) = (P6(r, c) - L.row(r).head(c).dot(L.row(c).head(c))) / L(c, c);
  }
  return L;
}

QualityTest::QualityTest(int samples) : samples_(halton_normal_8d(samples)) {}

double QualityTest::relative_entropy(const Sighting& i, const Sighting& j, const Matrix6d& P6, double sigma_rad) const {
  const auto at = linearise(i, j, P6, sigma_rad);
  if (!at) return std::numeric_limits<double>::infinity();
  double sum = 0.0;
  for (const Vector8d& sample : samples_) sum += entropy_term(*at, sample);
  return sum / static_cast<double>(samples_.size());
}

std::vector<double> QualityTest::terms(const Sighting& i, const Sighting& j, const Matrix6d& P6, double sigma_rad,
                                       int count) const {
  const auto at = linearise(i, j, P6, sigma_rad);
  std::vector<double> values;
  if (!at) return values;
  const auto wanted = std::min(as_size(count), samples_.size());
  for (std::size_t k = 0; k < wanted; ++k) values.push_back(entropy_term(*at, samples_[k]));
  return values;
}

}  // namespace azimuth
