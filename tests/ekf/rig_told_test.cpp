// Estimates of the rig's errors from a filter that only considers them, above all of the lag: images that were taken
// earlier than their stamps say.

#include "slam/ekf/rig_told.hpp"

#include <Eigen/LU>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vector>

#include "slam/ekf/bearing_ekf.hpp"
#include "tests/geometry/numeric_jacobian.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

constexpr double kPeriod_s = 0.25, kSpeed_m_per_s = 0.3, kSigmaSeen_rad = 0.01;
constexpr int kImages = 200;

/// The robot turns to the left and to the right in alternation.
double turn_rate_rad_per_s(int image) { return 0.6 * std::sin(0.1 * image); }

Control control_of(int image) { return {kSpeed_m_per_s * kPeriod_s, 0.0, turn_rate_rad_per_s(image) * kPeriod_s}; }
Eigen::Vector3d velocity_of(int image) { return {kSpeed_m_per_s, 0.0, turn_rate_rad_per_s(image)}; }

Pose2 earlier(const Pose2& pose, const Eigen::Vector3d& velocity, double by_s) {
  return pose * Pose2{-by_s * velocity.x(), 0.0, -by_s * velocity.z()};
}

/// The lag that the filter finds when it sees twelve landmarks `lag_s` earlier than the stamps say.
LagFound found_after_a_drive(double lag_s, const Eigen::Vector2d& sigma_scales, RandomDraws& draws) {
  BearingEkfSettings settings;
  settings.sigma_considered.head<2>() = sigma_scales;
  settings.sigma_considered(considered::lag) = 0.02;
  BearingEkf ekf(settings);
  const MotionNoise noise{.lambda_distance_m = 1e-4, .lambda_rotation_rad = 1e-4};
  Pose2 pose;
  std::vector<Eigen::Vector2d> landmarks;
  std::vector<Index> rays;
  for (int i = 0; i < 12; ++i) {
    landmarks.emplace_back(draws.uniform(-6.0, 12.0), (i % 2 == 0 ? 1.0 : -1.0) * draws.uniform(2.0, 6.0));
    const Eigen::Vector2d p = inverse(earlier(pose, velocity_of(0), lag_s)) * landmarks.back();
    rays.push_back(
        ekf.add_ray(wrap(std::atan2(p.y(), p.x()) + draws.normal(kSigmaSeen_rad)), kSigmaSeen_rad, 0.25, 0.25));
  }
  for (int k = 0; k < kImages; ++k) {
    const Control told = control_of(k);
    Motion motion;
    append(motion, told, told, noise);
    const Eigen::Vector3d start = velocity_of(std::max(k - 1, 0)), end = velocity_of(k);
    const double heading_rad = motion.T_start_end.heading_rad;
    motion.by_lag = apply({}, motion).G * start -
                    Eigen::Vector3d(std::cos(heading_rad) * end.x(), std::sin(heading_rad) * end.x(), end.z());
    ekf.predict(motion);
    pose = move(pose, told);
    // The true pose follows odometry with the noise that the filter assumes.
    pose = pose * Pose2{draws.normal(std::sqrt(1e-4 * kSpeed_m_per_s * kPeriod_s)), 0.0,
                        draws.normal(std::sqrt(1e-4 * std::abs(told.second_turn_rad)))};
    const Pose2 seen_from = earlier(pose, end, lag_s);
    std::vector<MappedSighting> sightings;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Eigen::Vector2d p = inverse(seen_from) * landmarks[i];
      sightings.push_back({JointState::kPose, rays[i], BlockKind::inverse_depth,
                           wrap(std::atan2(p.y(), p.x()) + draws.normal(kSigmaSeen_rad)),
                           kSigmaSeen_rad * kSigmaSeen_rad});
    }
    EXPECT_TRUE(ekf.update(sightings));
  }
  const std::optional<LagFound> found = lag_found(ekf.state(), told_of_rig(ekf.state()));
  EXPECT_TRUE(found);
  return found.value_or(LagFound{});
}

/// Over many drives the error agrees with its standard deviation, and the latter is small compared with relevant lags.
TEST(LagFound, IsThatOfTheImagesWithinItsSigma) {
  constexpr int kDrives = 40;
  for (const double lag_s : {-0.06, 0.0, 0.06}) {
    RandomDraws draws(7);
    double squared = 0.0, sum_s = 0.0, sigma_s = 0.0;
    for (int drive = 0; drive < kDrives; ++drive) {
      const LagFound found = found_after_a_drive(lag_s, {0.01, 0.01}, draws);
      squared += std::pow((found.mean_s - lag_s) / found.sigma_s, 2) / kDrives;
      sum_s += found.mean_s / kDrives;
      sigma_s += found.sigma_s / kDrives;
    }
    fmt::print(
        "lag {:+.3f} s: found {:+.4f} s on the average, sigma {:.4f} s, squared error over its variance {:.2f}\n",
        lag_s, sum_s, sigma_s, squared);
    EXPECT_NEAR(sum_s, lag_s, 0.006);
    EXPECT_LT(sigma_s, 0.012);
    EXPECT_LT(squared, 2.0);
  }
}

using Errors = Eigen::Matrix<double, considered::kCount, considered::kCount>;

/// A linear filter over pose and constants must agree with the filter over the pose alone, which considers the
/// constants and takes over values for them on the way through JointState::believe().
TEST(RigTold, PutRightByItAFilterIsOneThatEstimatesTheConstants) {
  constexpr int kAll = 3 + considered::kCount;
  RandomDraws draws(8);
  const Eigen::Matrix3d P0 = draws.covariance(3, 0.01);
  const Considered variances = Considered::LinSpaced(1e-4, 1e-3);
  JointState state({}, P0);
  state.consider(variances);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(kAll);
  Eigen::MatrixXd P = Eigen::MatrixXd::Zero(kAll, kAll);
  P.topLeftCorner<3, 3>() = P0;
  P.bottomRightCorner<considered::kCount, considered::kCount>() = variances.asDiagonal();
  for (int k = 0; k < 40; ++k) {
    if (k == 15 || k == 30) state.believe(0.02 * draws.normals(considered::kCount), JointState::Retraction::additive);
    Eigen::MatrixXd A = Eigen::MatrixXd::Identity(kAll, kAll);
    A.topLeftCorner<3, 3>() += 0.05 * Eigen::Map<Eigen::Matrix3d>(Eigen::VectorXd(draws.normals(9)).data());
    const JointState::ByConsidered B = Eigen::Map<const JointState::ByConsidered>(
        Eigen::VectorXd(0.3 * draws.normals(JointState::ByConsidered::SizeAtCompileTime)).data());
    A.topRightCorner<3, considered::kCount>() = B;
    const Eigen::Matrix3d G = A.topLeftCorner<3, 3>(), Q = draws.covariance(3, 0.01);
    const Eigen::Vector3d moved = G * state.pose().vector() + B * state.believed();
    state.move_robot({moved.x(), moved.y(), moved.z()}, G, Q, B);
    x = (A * x).eval();
    P = (A * P * A.transpose()).eval();
    P.topLeftCorner<3, 3>() += Q;
    const Eigen::Vector3d h = draws.normals(3);
    ObservationRow row;
    row.add(JointState::kPose, {h.data(), 3});
    row.variance = 1e-3;
    const double measured = draws.normal(0.05);
    row.innovation = measured - h.dot(state.pose().vector());
    ASSERT_TRUE(state.update(std::vector<ObservationRow>{row}, JointState::Retraction::additive));
    const Eigen::VectorXd PHt = P.leftCols<3>() * h;
    const double S = h.dot(PHt.head<3>()) + row.variance;
    x += PHt * (measured - h.dot(x.head<3>())) / S;
    P -= PHt * PHt.transpose() / S;
  }
  JointState::ByConsidered D;
  for (Index i = 0; i < 3; ++i) D.row(i) = state.by_considered(i);
  const JointState::Told& told = state.told_of_considered();
  const Errors M = (told.information + Errors(variances.cwiseInverse().asDiagonal())).inverse();
  const Considered m = M * told.pull;
  EXPECT_LT(largest_difference(m, x.tail<considered::kCount>()), 1e-9);
  EXPECT_LT(largest_difference(M, P.bottomRightCorner<considered::kCount, considered::kCount>()), 1e-9);
  EXPECT_LT(largest_difference(state.pose().vector() + D * (m - state.believed()), x.head<3>()), 1e-9);
  EXPECT_LT(largest_difference(state.pose_covariance() + D * M * D.transpose(), P.topLeftCorner<3, 3>()), 1e-9);
}

/// Among constants that explain the same measurements, a constant must not be doubted when its own standard deviation
/// covers the rest of its error.
TEST(RigTold, NothingIsDoubtedThatItsOwnErrorBarCovers) {
  RandomDraws draws(9);
  int doubted = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    JointState state({}, 1e-12 * Eigen::Matrix3d::Identity());
    state.consider(Considered::Constant(1e-4));
    JointState::ByConsidered D = JointState::ByConsidered::Zero();
    for (int k = draws.integer(2, 12); k > 0; --k) {
      JointState::ByConsidered next = JointState::ByConsidered::Zero();
      for (int i = 0; i < 3; ++i) next(0, draws.integer(0, considered::kCount - 1)) = draws.normal(1.0);
      state.move_robot(state.pose(), Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Zero(), next - D);
      D = next;
      const double along_x = 1.0;
      ObservationRow row;
      row.add(JointState::kPose, {&along_x, 1});
      row.variance = 1e-3;
      row.innovation = draws.normal(0.3);
      ASSERT_TRUE(state.update(std::vector<ObservationRow>{row}, JointState::Retraction::additive));
    }
    const RigTold told = told_of_rig(state);
    for (int i = 0; i < considered::kCount; ++i) {
      if (!told.is_doubted(i)) continue;
      ++doubted;
      EXPECT_GT(std::abs(told.mean(i)), 2.0 * told.sigma(i)) << "constant " << i << " of trial " << trial;
    }
  }
  EXPECT_GT(doubted, 1000);
}

/// JointState::believe() moves a map as a correction does: the map turns as a whole and keeps its shape.
TEST(RigTold, AMapThatIsTurnedByWhatIsBelievedKeepsItsShape) {
  BearingEkfSettings settings;
  settings.sigma_considered(considered::yaw) = 0.01;
  BearingEkf ekf(settings);
  MapSnapshot map;
  for (const Eigen::Vector2d& p : {Eigen::Vector2d(6.0, -2.0), Eigen::Vector2d(3.0, 5.0)})
    map.landmarks.push_back({.id = 0, .p_map_landmark_m = p});
  map.covariance.resize(map.entries());
  const std::vector<Index> blocks = ekf.restore(map);
  const double apart_m = (ekf.state().position(blocks[0]) - ekf.state().position(blocks[1])).norm();
  ekf.believe(0.3 * Considered::Unit(considered::yaw));
  EXPECT_NEAR(ekf.state().pose().heading_rad, 0.3, 1e-12);
  EXPECT_NEAR((ekf.state().position(blocks[0]) - ekf.state().position(blocks[1])).norm(), apart_m, 1e-9);
  EXPECT_NEAR(std::atan2(ekf.state().position(blocks[0]).y(), ekf.state().position(blocks[0]).x()),
              std::atan2(-2.0, 6.0) + 0.3, 1e-9);
}

TEST(LagFound, SaysNothingBeforeAnythingWasHeard) {
  BearingEkf ekf(BearingEkfSettings{});
  EXPECT_FALSE(lag_found(ekf.state(), told_of_rig(ekf.state())));
}

}  // namespace
}  // namespace azimuth
