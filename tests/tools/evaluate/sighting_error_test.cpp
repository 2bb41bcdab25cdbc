#include "tools/evaluate/sighting_error.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "slam/geometry/angle.hpp"
#include "tests/geometry/random_draws.hpp"
#include "tests/support/stamps.hpp"

namespace azimuth {
namespace {

constexpr double kSigma_rad = 0.005;

/// True poses of a robot on a circle of 3 m radius, one per second.
std::vector<StampedPose> circle(int poses) {
  std::vector<StampedPose> truth;
  for (int k = 0; k < poses; ++k) {
    const double angle_rad = 2.0 * kPi * k / 40.0;
    truth.push_back({at_s(k), {3.0 * std::cos(angle_rad), 3.0 * std::sin(angle_rad), wrap(angle_rad + kPi / 2)}});
  }
  return truth;
}

SightingRecord sighting_of(std::int64_t id, const Eigen::Vector2d& point_m, const StampedPose& from, double error_rad) {
  const Eigen::Vector2d to = point_m - from.pose.position();
  const double direction_rad = std::atan2(to.y(), to.x());
  return {from.stamp, id, wrap(direction_rad - from.pose.heading_rad + error_rad), kSigma_rad};
}

TEST(SightingErrors, RightSightingsAreRight) {
  RandomDraws draws(121);
  const std::vector<StampedPose> truth = circle(40);
  std::vector<SightingRecord> sightings;
  for (std::int64_t id = 0; id < 20; ++id) {
    const Eigen::Vector2d landmark = draws.point(8.0) + Eigen::Vector2d(9.0, 0.0);
    for (const StampedPose& pose : truth)
      sightings.push_back(sighting_of(id, landmark, pose, draws.normal(kSigma_rad)));
  }
  const SightingErrors errors = sighting_errors(sightings, truth);
  EXPECT_EQ(errors.judged, 800u);
  EXPECT_EQ(errors.wrong, 0u);
}

TEST(SightingErrors, CountsSightingsOfSomethingElse) {
  RandomDraws draws(122);
  const std::vector<StampedPose> truth = circle(40);
  std::vector<SightingRecord> sightings;
  std::size_t initialised = 0;
  for (std::int64_t id = 0; id < 30; ++id) {
    const Eigen::Vector2d landmark = draws.point(6.0) + Eigen::Vector2d(10.0, 0.0);
    for (const StampedPose& pose : truth) {
      const bool wrong = draws.chance(0.2);
      const double off_rad = wrong ? draws.uniform(0.1, 3.0) : draws.normal(kSigma_rad);
      initialised += wrong ? 1 : 0;
      sightings.push_back(sighting_of(id, landmark, pose, off_rad));
    }
  }
  EXPECT_EQ(sighting_errors(sightings, truth).wrong, initialised);
}

TEST(SightingErrors, ALandmarkMadeOfTwoIsHalfWrong) {
  const std::vector<StampedPose> truth = circle(40);
  std::vector<SightingRecord> sightings;
  for (const StampedPose& pose : truth) {
    const bool first = sightings.size() < 24;
    sightings.push_back(sighting_of(1, first ? Eigen::Vector2d(9.0, 0.0) : Eigen::Vector2d(-9.0, 3.0), pose, 0.0));
  }
  EXPECT_NEAR(static_cast<double>(sighting_errors(sightings, truth).wrong), 16.0, 1.0);
}

TEST(SightingErrors, JudgesNothingWithoutParallaxOrTruth) {
  const std::vector<StampedPose> truth = circle(40);
  const Eigen::Vector2d landmark(9.0, 0.0);
  std::vector<SightingRecord> two{sighting_of(1, landmark, truth[0], 0.0), sighting_of(1, landmark, truth[5], 0.0)};
  EXPECT_EQ(sighting_errors(two, truth).judged, 0u) << "two rays always meet";
  const std::vector<SightingRecord> one_place(5, sighting_of(1, landmark, truth[0], 0.0));
  EXPECT_EQ(sighting_errors(one_place, truth).judged, 0u);
  two.push_back(sighting_of(1, landmark, truth[9], 0.0));
  EXPECT_EQ(sighting_errors(two, truth).judged, 3u);
  EXPECT_EQ(sighting_errors(two, {}).judged, 0u);
}

}  // namespace
}  // namespace azimuth
