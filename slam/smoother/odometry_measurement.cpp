#include "slam/smoother/odometry_measurement.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cassert>
#include <cmath>

#include "slam/smoother/factors.hpp"

namespace azimuth {
namespace {

/// Returns W with W^T W = covariance^-1.
Eigen::Matrix3d whitening_of(const Eigen::Matrix3d& covariance) {
  const Eigen::LLT<Eigen::Matrix3d> factor(covariance);
  assert(factor.info() == Eigen::Success);
  return factor.matrixL().solve(Eigen::Matrix3d::Identity());
}

/// d(end of the motion) / d(calibration). A drift turns the direction of travel by half of the gained heading.
Eigen::Matrix<double, 3, kMotionCalibrations> by_calibration(const Motion& motion) {
  const Pose2& T = motion.T_start_end;
  const double driven_m = std::copysign(motion.path_m, T.x_m);
  Eigen::Matrix<double, 3, kMotionCalibrations> by;
  by << motion.by_scales, driven_m * Eigen::Vector3d(-0.5 * T.y_m, 0.5 * T.x_m, 1.0);
  return by;
}

}  // namespace

Eigen::Matrix3d OdometryMeasurement::covariance() const {
  const Eigen::Matrix3d spread = whitening.inverse();
  return spread * spread.transpose();
}

OdometryMeasurement odometry_measurement(const Motion& motion, const ByLag& by_lag) {
  OdometryMeasurement measured;
  measured.relative = motion.T_start_end.vector();
  measured.whitening = whitening_of(motion.covariance);
  measured.by_calibration << by_calibration(motion), by_lag;
  return measured;
}

Motion motion_of(const OdometryMeasurement& measured) {
  Motion motion;
  motion.T_start_end = {measured.relative.x(), measured.relative.y(), measured.relative.z()};
  motion.covariance = measured.covariance();
  motion.path_m = measured.relative.head<2>().norm();
  motion.turned_rad = std::abs(measured.relative.z());
  motion.by_scales = measured.by_calibration.leftCols<2>();
  return motion;
}

OdometryMeasurement composed(const OdometryMeasurement& first, const OdometryMeasurement& second) {
  Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
  turned.topLeftCorner<2, 2>() = rotation(first.relative.z());
  OdometryMeasurement whole;
  whole.relative = first.relative + turned * second.relative;
  whole.relative.z() = wrap(whole.relative.z());
  const Eigen::Matrix3d G = by_first(first.relative, whole.relative);
  whole.whitening =
      whitening_of(G * first.covariance() * G.transpose() + turned * second.covariance() * turned.transpose());
  whole.by_calibration = G * first.by_calibration + turned * second.by_calibration;
  return whole;
}

Eigen::Matrix3d by_first(const Eigen::Vector3d& first, const Eigen::Vector3d& composed) {
  const Eigen::Vector3d rest = composed - first;
  Eigen::Matrix3d G = Eigen::Matrix3d::Identity();
  G(0, 2) = -rest.y();
  G(1, 2) = rest.x();
  return G;
}

}  // namespace azimuth
