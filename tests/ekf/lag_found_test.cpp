// Images that are taken earlier than stamped: what a filter that does not know of it hears of the lag.

#include "slam/ekf/lag_found.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vector>

#include "slam/ekf/bearing_ekf.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

constexpr double kPeriod_s = 0.25, kSpeed_m_per_s = 0.3, kSigmaSeen_rad = 0.01;
constexpr int kImages = 200;

/// Now and then the robot turns to one side, now and then to the other.
double turn_rate_rad_per_s(int image) { return 0.6 * std::sin(0.1 * image); }

Control control_of(int image) { return {kSpeed_m_per_s * kPeriod_s, 0.0, turn_rate_rad_per_s(image) * kPeriod_s}; }
Eigen::Vector3d velocity_of(int image) { return {kSpeed_m_per_s, 0.0, turn_rate_rad_per_s(image)}; }

Pose2 earlier(const Pose2& pose, const Eigen::Vector3d& velocity, double by_s) {
  return pose * Pose2{-by_s * velocity.x(), 0.0, -by_s * velocity.z()};
}

/// What a filter says that sees twelve landmarks `lag_s` earlier than it is told.
LagFound found_after_a_drive(double lag_s, const Eigen::Vector2d& sigma_scales, RandomDraws& draws) {
  BearingEkfSettings settings;
  settings.sigma_scales = sigma_scales;
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
    // The truth goes as odometry says, but for its noise.
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
  const std::optional<LagFound> found = lag_found(ekf.state());
  EXPECT_TRUE(found);
  return found.value_or(LagFound{});
}

/// Over many drives the error is what its sigma says, and small beside the lags that matter.
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

TEST(LagFound, SaysNothingBeforeAnythingWasHeard) {
  BearingEkf ekf(BearingEkfSettings{});
  EXPECT_FALSE(lag_found(ekf.state()));
}

}  // namespace
}  // namespace azimuth
