// The misfit of bearings and odometry, the share of their residuals that the unknowns take up, and what they tell of
// the rig.

#include <cassert>
#include <cmath>

#include "slam/smoother/bearing_graph.hpp"

namespace azimuth {
namespace {

/// Returns +1 or -1, the last bit of splitmix64, equal on every machine.
double sign_of(std::uint64_t seed, std::int32_t id, int part) {
  std::uint64_t z =
      0x9e3779b97f4a7c15U * (seed + 1) + 4U * static_cast<std::uint64_t>(id) + static_cast<unsigned>(part);
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return ((z ^ (z >> 31U)) & 1U) != 0 ? 1.0 : -1.0;
}

}  // namespace

void BearingGraph::set_calibration_sigma(int which, double sigma) {
  assert(calibrates(which) && sigma > 0.0);
  calibration_sigma_[static_cast<std::size_t>(which)] = sigma;
  stale_.emplace_back(kCalibrationBlock, kCalibrationBlock);
}

void BearingGraph::scale_noise(double bearings, double odometry) {
  for (BearingId id = 0; id < bearings_.size(); ++id) bearings_.edit(id).sigma_rad *= bearings;
  for (PoseId id = 0; id < poses_.size(); ++id) {
    odometry_.edit(id).whitening /= odometry;
    poses_.edit(id).moved = true;
  }
}

BearingGraph::Misfit BearingGraph::misfit_of_bearings() const {
  Misfit misfit;
  for (BearingId id = 0; id < bearings_.size(); ++id) {
    if (landmark_of(id) == kOfNothing || chi2_of(id) >= kScattersChi2) continue;  // wrong association
    misfit.chi2 += links_[id].weight * chi2_of(id);
    ++misfit.residuals;
  }
  return misfit;
}

OdometryMeasurement BearingGraph::odometry_over(PoseId start, PoseId end) const {
  OdometryMeasurement whole = odometry_[start + 1];
  for (PoseId id = start + 2; id <= end; ++id) whole = composed(whole, odometry_[id]);
  return whole;
}

BearingGraph::Misfit BearingGraph::misfit_of_odometry(int stride) const {
  Misfit misfit;
  for (PoseId start = 0; start + stride < poses_.size(); start += stride) {
    const OdometryMeasurement measured = odometry_over(start, start + stride);
    Eigen::Vector3d off = relative_pose(poses_[start].state, poses_[start + stride].state) - measured.relative -
                          measured.by_calibration * calibration_.head<kOdometryCalibrations>();
    off.z() = wrap(off.z());
    misfit.chi2 += (measured.whitening * off).squaredNorm();
    misfit.residuals += 3;
  }
  return misfit;
}

Eigen::VectorXd BearingGraph::signed_sum_of_bearings(std::uint64_t seed) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(rows_);
  for (BearingId id = 0; id < bearings_.size(); ++id)
    if (landmark_of(id) != kOfNothing)
      add_pull(links_[id], bearings_[id], sign_of(seed, id, 0) * std::sqrt(links_[id].weight), sum);
  return sum;
}

BearingGraph::ByCalibration BearingGraph::by_calibration() const {
  ByCalibration by{.mixed = Eigen::Matrix<double, Eigen::Dynamic, kCalibrations>::Zero(rows_, kCalibrations)};
  for (PoseId id = 1; id < poses_.size(); ++id) {
    const OdometryMeasurement& measured = odometry_[id];
    const PoseEntry &start = poses_[id - 1], &end = poses_[id];
    const SeenMotion seen = see_motion(start.state, end.state);
    const Eigen::Matrix<double, 3, kOdometryCalibrations> by_errors = -measured.whitening * measured.by_calibration;
    const Eigen::Matrix<double, 3, kOdometryCalibrations> pull = measured.whitening.transpose() * by_errors;
    by.slope.head<kOdometryCalibrations>() -= measured.by_calibration.transpose() * end.pull;
    by.curvature.topLeftCorner<kOdometryCalibrations, kOdometryCalibrations>() += by_errors.transpose() * by_errors;
    if (size(start.block) > 0)
      by.mixed.block<3, kOdometryCalibrations>(first_row(start.block), 0) += seen.by_start.transpose() * pull;
    by.mixed.block<3, kOdometryCalibrations>(first_row(end.block), 0) += seen.by_end.transpose() * pull;
  }
  for (BearingId id = 0; id < bearings_.size(); ++id) {
    if (landmark_of(id) == kOfNothing) continue;
    const Link& link = links_[id];
    const ByCamera by_errors = by_camera(link, bearings_[id]);
    const ByCamera weighted = link.weight * by_errors;
    by.slope.tail<kCameraCalibrations>() += link.residual * weighted;
    by.curvature.bottomRightCorner<kCameraCalibrations, kCameraCalibrations>() += weighted * by_errors.transpose();
    const Block pose = poses_[bearings_[id].pose].block;
    if (size(pose) > 0)
      by.mixed.block<3, kCameraCalibrations>(first_row(pose), kOdometryCalibrations) +=
          link.by_pose * weighted.transpose();
    by.mixed.block<2, kCameraCalibrations>(first_row(landmarks_[link.landmark].block), kOdometryCalibrations) +=
        link.by_landmark * weighted.transpose();
  }
  return by;
}

void BearingGraph::correct(const Calibration& errors) {
  for (BearingId id = 0; id < bearings_.size(); ++id) {
    BearingMeasurement& measured = bearings_.edit(id);
    measured.azimuth_rad = wrap(measured.azimuth_rad + errors[calibration::yaw]);
    links_.edit(id).changed = true;
  }
  for (PoseId id = 1; id < poses_.size(); ++id) {
    OdometryMeasurement& measured = odometry_.edit(id);
    measured.relative += measured.by_calibration * errors.head<kOdometryCalibrations>();
    measured.relative.z() = wrap(measured.relative.z());
  }
  for (const int i : {calibration::camera_x, calibration::camera_y}) calibration_[i] += errors[i];
  for (PoseId id = 0; id < poses_.size(); ++id) poses_.edit(id).moved = true;
}

Eigen::VectorXd BearingGraph::signed_sum_of_odometry(std::uint64_t seed, int stride) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(rows_);
  for (PoseId id = 0; id + stride < poses_.size(); id += stride) {
    const PoseEntry &start = poses_[id], &end = poses_[id + stride];
    const OdometryMeasurement measured = odometry_over(id, id + stride);
    const Eigen::Vector3d signs(sign_of(seed, id, 1), sign_of(seed, id, 2), sign_of(seed, id, 3));
    const Eigen::Vector3d pull = measured.whitening.transpose() * signs;
    const SeenMotion seen = see_motion(start.state, end.state);
    if (size(start.block) > 0) sum.segment<3>(first_row(start.block)) += seen.by_start.transpose() * pull;
    sum.segment<3>(first_row(end.block)) += seen.by_end.transpose() * pull;
    for (std::size_t i = 0; i < kOdometryCalibrations; ++i)
      if (const int row = calibration_row_[i]; row >= 0)
        sum[row] -= measured.by_calibration.col(static_cast<Eigen::Index>(i)).dot(pull);
  }
  return sum;
}

}  // namespace azimuth
