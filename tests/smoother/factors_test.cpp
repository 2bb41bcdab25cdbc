// Compares each derivative with finite differences, for landmarks near, far, at infinity and beyond.

#include "slam/smoother/factors.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "slam/geometry/random.hpp"

namespace azimuth {
namespace {

constexpr double kDifference = 1e-6;

double azimuth_of(const SmoothedPose& pose, const SmoothedLandmark& landmark) {
  SeenAzimuth seen;
  EXPECT_TRUE(see(pose, landmark, 0.05, seen));
  return seen.azimuth_rad;
}

void expect_derivatives(const SmoothedPose& pose, const SmoothedLandmark& landmark) {
  SeenAzimuth seen;
  ASSERT_TRUE(see(pose, landmark, 0.05, seen));
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d step = kDifference * Eigen::Vector3d::Unit(i);
    const double slope =
        wrap(azimuth_of(pose.moved(step), landmark) - azimuth_of(pose.moved(-step), landmark)) / (2 * kDifference);
    EXPECT_NEAR(seen.by_pose[i], slope, 1e-6 * (1.0 + std::abs(slope)));
  }
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d step = kDifference * Eigen::Vector2d::Unit(i);
    const double slope =
        wrap(azimuth_of(pose, landmark.moved(step)) - azimuth_of(pose, landmark.moved(-step))) / (2 * kDifference);
    EXPECT_NEAR(seen.by_landmark[i], slope, 1e-6 * (1.0 + std::abs(slope)));
  }
}

TEST(SeenAzimuth, IsThatOfThePoint) {
  const SmoothedPose pose({1.0, 2.0, 0.3});
  const SmoothedLandmark landmark({0.5, -1.0}, 0.8, 0.25);
  const Eigen::Vector2d to_landmark = landmark.p_map() - pose.T_map_body.position();
  EXPECT_NEAR(azimuth_of(pose, landmark), std::atan2(to_landmark.y(), to_landmark.x()) - 0.3, 1e-12);
}

TEST(SeenAzimuth, AtInfinityIsTheDirectionWhereverOneStands) {
  const SmoothedLandmark landmark({5.0, 5.0}, 1.2, 0.0);
  EXPECT_FALSE(landmark.is_point());
  for (const Pose2 pose : {Pose2{}, Pose2{100.0, -30.0, 0.0}})
    EXPECT_NEAR(azimuth_of(SmoothedPose(pose), landmark), 1.2, 1e-12);
}

TEST(SeenAzimuth, NothingIsSeenOfWhatIsTooNear) {
  const SmoothedLandmark landmark({0.0, 0.0}, 0.0, 0.5);  // at (2, 0)
  SeenAzimuth seen;
  EXPECT_FALSE(see(SmoothedPose({1.96, 0.0, 0.0}), landmark, 0.05, seen));
  EXPECT_TRUE(see(SmoothedPose({1.94, 0.0, 0.0}), landmark, 0.05, seen));
  // At the landmark itself no direction is defined, for any camera yaw.
  EXPECT_FALSE(see(SmoothedPose({2.0, 0.0, 0.0}), landmark, 0.0, seen));
}

TEST(SeenAzimuth, DerivativesAtTheChartsOriginAndOnBothSidesOfInfinity) {
  for (const double inverse_distance : {2.0, 0.35, 1e-9, 0.0, -1e-9, -0.1})
    for (const Pose2& pose : {Pose2{}, Pose2{0.1, -0.2, 3.0}, Pose2{-1.0, 0.7, -1.5}})
      expect_derivatives(SmoothedPose(pose), {{0.0, 0.0}, 0.7, inverse_distance});
}

RC_GTEST_PROP(SeenAzimuthProperty, DerivativesAnywhere, (std::uint64_t seed)) {
  RandomNumbers<SplitMix> numbers{SplitMix(seed)};
  const SmoothedPose pose({numbers.uniform(-9, 9), numbers.uniform(-9, 9), numbers.uniform(-3, 3)});
  const SmoothedLandmark landmark({numbers.uniform(-9, 9), numbers.uniform(-9, 9)}, numbers.uniform(-3, 3),
                                  numbers.uniform(-0.5, 2.0));
  SeenAzimuth seen;
  // Derivatives grow as the landmark comes nearer, and so does the error of finite differences.
  RC_PRE(see(pose, landmark, 0.3, seen) && seen.by_pose.norm() < 10.0 && seen.by_landmark.norm() < 100.0);
  expect_derivatives(pose, landmark);
}

double elevation_of(const SmoothedPose& pose, const SmoothedLandmark& landmark, double tangent) {
  SeenElevation seen;
  EXPECT_TRUE(see_height(pose, landmark, tangent, 0.05, seen));
  return seen.elevation_rad;
}

TEST(SeenElevation, IsThatOfThePoint) {
  const SmoothedPose pose({1.0, 2.0, 0.3});
  const SmoothedLandmark landmark({0.5, -1.0}, 0.8, 0.25);
  const double distance_m = (landmark.p_map() - pose.T_map_body.position()).norm();
  EXPECT_NEAR(elevation_of(pose, landmark, 3.0 * 0.25), std::atan2(3.0, distance_m), 1e-12);
  EXPECT_NEAR(elevation_of(pose, landmark, -3.0 * 0.25), -std::atan2(3.0, distance_m), 1e-12);
}

RC_GTEST_PROP(SeenElevationProperty, DerivativesAnywhere, (std::uint64_t seed)) {
  RandomNumbers<SplitMix> numbers{SplitMix(seed)};
  const SmoothedPose pose({numbers.uniform(-9, 9), numbers.uniform(-9, 9), numbers.uniform(-3, 3)});
  const SmoothedLandmark landmark({numbers.uniform(-9, 9), numbers.uniform(-9, 9)}, numbers.uniform(-3, 3),
                                  numbers.uniform(-0.5, 2.0));
  const double tangent = numbers.uniform(-3, 3);
  SeenElevation seen;
  SeenAzimuth near;
  RC_PRE(see(pose, landmark, 0.3, near) && near.by_pose.norm() < 10.0 && near.by_landmark.norm() < 100.0);
  ASSERT_TRUE(see_height(pose, landmark, tangent, 0.3, seen));
  const auto slope_is = [](double slope, double minus, double plus) {
    EXPECT_NEAR(slope, (plus - minus) / (2 * kDifference), 1e-6 * (1.0 + std::abs(slope)));
  };
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d step = kDifference * Eigen::Vector3d::Unit(i);
    slope_is(seen.by_pose[i], elevation_of(pose.moved(-step), landmark, tangent),
             elevation_of(pose.moved(step), landmark, tangent));
  }
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d step = kDifference * Eigen::Vector2d::Unit(i);
    slope_is(seen.by_landmark[i], elevation_of(pose, landmark.moved(-step), tangent),
             elevation_of(pose, landmark.moved(step), tangent));
  }
  slope_is(seen.by_tangent, elevation_of(pose, landmark, tangent - kDifference),
           elevation_of(pose, landmark, tangent + kDifference));
}

RC_GTEST_PROP(SeenMotionProperty, DerivativesAnywhere, (std::uint64_t seed)) {
  RandomNumbers<SplitMix> numbers{SplitMix(seed)};
  const auto draw = [&] {
    return SmoothedPose({numbers.uniform(-5, 5), numbers.uniform(-5, 5), numbers.uniform(-3, 3)});
  };
  const SmoothedPose start = draw(), end = draw();
  const SeenMotion seen = see_motion(start, end);
  RC_ASSERT((seen.relative - (inverse(start.T_map_body) * end.T_map_body).vector()).norm() < 1e-9);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d step = kDifference * Eigen::Vector3d::Unit(i);
    Eigen::Vector3d by_start = relative_pose(start.moved(step), end) - relative_pose(start.moved(-step), end);
    Eigen::Vector3d by_end = relative_pose(start, end.moved(step)) - relative_pose(start, end.moved(-step));
    by_start.z() = wrap(by_start.z());
    by_end.z() = wrap(by_end.z());
    RC_ASSERT((seen.by_start.col(i) - by_start / (2 * kDifference)).norm() < 1e-6);
    RC_ASSERT((seen.by_end.col(i) - by_end / (2 * kDifference)).norm() < 1e-6);
  }
}

RC_GTEST_PROP(SeenMotionProperty, TurningTheMapChangesNoDerivative, (std::uint64_t seed)) {
  RandomNumbers<SplitMix> numbers{SplitMix(seed)};
  const auto draw = [&] { return Pose2{numbers.uniform(-5, 5), numbers.uniform(-5, 5), numbers.uniform(-3, 3)}; };
  const Pose2 start = draw(), end = draw(), turn = draw();
  const SeenMotion here = see_motion(SmoothedPose(start), SmoothedPose(end));
  const SeenMotion there = see_motion(SmoothedPose(turn * start), SmoothedPose(turn * end));
  RC_ASSERT((here.by_start - there.by_start).norm() + (here.by_end - there.by_end).norm() < 1e-9);
}

TEST(SmoothedLandmark, DerivativeOfThePoint) {
  const SmoothedLandmark landmark({1.0, 2.0}, 2.2, 0.4);
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d step = kDifference * Eigen::Vector2d::Unit(i);
    const Eigen::Vector2d slope = (landmark.moved(step).p_map() - landmark.moved(-step).p_map()) / (2 * kDifference);
    EXPECT_LT((landmark.p_by_chart().col(i) - slope).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace azimuth
