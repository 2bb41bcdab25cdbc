#include "slam/localisation/relocaliser.hpp"

#include <gtest/gtest.h>
#include <limits>

#include "slam/localisation/motion_chain.hpp"
#include "slam/localisation/pose_search.hpp"
#include "tests/localisation/kidnapping.hpp"

namespace azimuth {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Eigen::Vector2d unit_towards(const Pose2& T_map_body, const Eigen::Vector2d& p_map) {
  return (inverse(T_map_body) * p_map).normalized();
}

void expect_same(const Pose2& a, const Pose2& b, double tolerance) {
  EXPECT_NEAR(a.x_m, b.x_m, tolerance);
  EXPECT_NEAR(a.y_m, b.y_m, tolerance);
  EXPECT_NEAR(wrap(a.heading_rad - b.heading_rad), 0.0, tolerance);
}

TEST(PoseFromDirections, ThreeOfThemGiveTheTruePose) {
  RandomDraws draws(1);
  int solved = 0;
  for (int i = 0; i < 2000; ++i) {
    const Pose2 truth = draws.pose(5.0);
    std::array<Eigen::Vector2d, 3> p_map, to_landmark;
    for (std::size_t k = 0; k < 3; ++k) {
      p_map[k] = draws.point(8.0);
      to_landmark[k] = unit_towards(truth, p_map[k]);
    }
    const auto pose = pose_from_directions(p_map, to_landmark);
    if (!pose) continue;  // the position lies on or near the circle through all three landmarks
    ++solved;
    expect_same(*pose, truth, 1e-6);
  }
  EXPECT_GT(solved, 1900);
}

/// With an uncertain heading, a wrong direction fits the prediction, until the other directions determine the heading.
TEST(ImageMatch, LeavesOutInTheEndWhatFitsThePredictionAlone) {
  const std::vector<KnownLandmark> landmarks{{.p_map_m = {4.0, 0.0, kNan}},
                                             {.p_map_m = {0.0, 4.0, kNan}},
                                             {.p_map_m = {-4.0, 1.0, kNan}},
                                             {.p_map_m = {1.0, -4.0, kNan}}};
  KnownMap map;
  map.assign(landmarks, {.detection_probability = 0.8});
  std::vector<SeenDirection> seen;
  for (const KnownLandmark& landmark : landmarks) {
    const double azimuth_rad = std::atan2(landmark.p_map_m.y(), landmark.p_map_m.x());
    seen.push_back({.azimuth_rad = azimuth_rad, .sigma_rad = 0.02});
  }
  seen.back().azimuth_rad += 0.15;
  RaysOfImage image;
  image.assign(seen, map, seen.size());
  ImageMatch match({});
  const PoseGaussian predicted{{}, Eigen::Vector3d(1e-4, 1e-4, 0.01).asDiagonal()};
  const auto compared = [&](int assignments) {
    Beliefs beliefs{.lit = LitOdds(landmarks.size(), 0.98F), .share = MappedShare(0.0)};
    return match.compare(map, image, predicted, beliefs, assignments);
  };
  ASSERT_TRUE(compared(1) && compared(2));
  EXPECT_EQ(compared(1)->explained, 4);
  EXPECT_EQ(compared(2)->explained, 3);
  EXPECT_GT(compared(2)->log_odds, compared(1)->log_odds);
  EXPECT_LT(std::abs(compared(2)->pose.T_map_body.heading_rad), 0.01);
}

TEST(PoseFromDirections, NothingComesOfACircleThroughAllFour) {
  const std::array<Eigen::Vector2d, 3> p_map{Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(-1, 0)};
  const Pose2 truth{0.0, -1.0, 0.3};
  EXPECT_FALSE(pose_from_directions(
      p_map, {unit_towards(truth, p_map[0]), unit_towards(truth, p_map[1]), unit_towards(truth, p_map[2])}));
}

TEST(PoseFromDirections, APairOfPlacesGivesTheTruePose) {
  RandomDraws draws(2);
  for (int i = 0; i < 200; ++i) {
    const Pose2 truth = draws.pose(5.0);
    const std::array<Eigen::Vector2d, 2> p_map{draws.point(8.0), draws.point(8.0)};
    const auto pose = pose_from_pair(p_map, {inverse(truth) * p_map[0], inverse(truth) * p_map[1]});
    ASSERT_TRUE(pose);
    expect_same(*pose, truth, 1e-9);
  }
  EXPECT_FALSE(
      pose_from_pair({Eigen::Vector2d(1, 1), Eigen::Vector2d(1, 1)}, {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0)}));
}

TEST(MotionChain, ThereAndBackIsNothing) {
  RandomDraws draws(3);
  Motion there;
  there.T_start_end = draws.pose(2.0);
  there.covariance = draws.covariance(3, 0.1);
  expect_same(chained(there, reversed(there)).T_start_end, {}, 1e-12);
  EXPECT_LT((reversed(reversed(there)).covariance - there.covariance).norm(), 1e-12);
}

TEST(DirectionModel, DerivativesAreThoseOfTheModel) {
  RandomDraws draws(4);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 100; ++i) {
    const Pose2 pose = draws.pose(3.0);
    KnownLandmark lamp;
    lamp.p_map_m = {draws.uniform(-5, 5), draws.uniform(-5, 5), draws.uniform(4, 7)};
    if (i % 2 == 0) lamp.p_map_m.z() = kNan;
    const Eigen::Vector3d v = CameraPlace(pose, 1.8)(lamp);
    SeenDirection seen{.azimuth_rad = wrap(std::atan2(v.y(), v.x()) + 0.1), .sigma_rad = 0.01};
    if (lamp.has_height()) {
      seen.elevation_rad = std::atan2(v.z(), v.head<2>().norm()) - 0.05;
      seen.sigma_elevation_rad = 0.01;
    }
    const SeenRay ray = *make_ray(seen);
    const auto at = appearance(pose, ray, lamp, 1.8);
    ASSERT_TRUE(at);
    EXPECT_EQ(at->rows, lamp.has_height() ? 2 : 1);
    for (Eigen::Index k = 0; k < 3; ++k) {
      Eigen::Vector3d more = pose.vector(), less = pose.vector();
      more(k) += kStep;
      less(k) -= kStep;
      const auto plus = appearance({more.x(), more.y(), more.z()}, ray, lamp, 1.8);
      const auto minus = appearance({less.x(), less.y(), less.z()}, ray, lamp, 1.8);
      ASSERT_TRUE(plus && minus);
      // the innovation is measured minus expected
      const Eigen::Vector2d slope = (minus->innovation - plus->innovation) / (2.0 * kStep);
      EXPECT_NEAR(slope.x(), at->by_pose(0, k), 1e-6);
      if (lamp.has_height()) {
        EXPECT_NEAR(slope.y(), at->by_pose(1, k), 1e-6);
      }
    }
  }
}

TEST(ImageMatch, TwoDirectionsInThePlaneSuggestNoPoseThreeDo) {
  RandomDraws draws(7);
  for (int i = 0; i < 200; ++i) {
    const Pose2 truth = draws.pose(5.0);
    std::vector<KnownLandmark> landmarks(3);
    std::vector<SeenDirection> seen;
    for (std::size_t k = 0; k < 3; ++k) {
      const double azimuth_rad = 2.0 * static_cast<double>(k) + draws.uniform(-0.5, 0.5);
      const Eigen::Vector2d p_map = truth * Eigen::Vector2d(3.0 * std::cos(azimuth_rad), 3.0 * std::sin(azimuth_rad));
      landmarks[k].p_map_m = {p_map.x(), p_map.y(), kNan};
      landmarks[k].covariance_m2 = 1e-4 * Eigen::Matrix3d::Identity();
      seen.push_back({.azimuth_rad = azimuth_rad, .sigma_rad = 0.01});
    }
    const auto compared = [&](std::size_t mapped) {
      KnownMap map;
      map.assign(std::span(landmarks).first(mapped), CameraView{});
      RaysOfImage image;
      image.assign(seen, map, 40);
      Beliefs beliefs{LitOdds(mapped, 0.98F), MappedShare(0.5)};
      return ImageMatch(RelocalisationSettings{}).compare_suggested(map, image, truth, beliefs);
    };
    EXPECT_FALSE(compared(2)) << i;
    const auto fixed = compared(3);
    ASSERT_TRUE(fixed) << i;
    EXPECT_EQ(fixed->explained, 3);
    EXPECT_LT(fixed->log_prior, 0.0);
  }
}

TEST(Relocaliser, IsNotFooledByAMapThatIsItsOwnMirror) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    // GIVEN lamps on an exact grid, which looks the same after half a turn
    RandomDraws draws(seed);
    KidnapWorld world = lamp_hall(draws, 0.0);
    world.map_sigma_m = 0.0;
    world.low_m = {6.0, -5.0};
    world.high_m = {30.0, 7.5};
    // WHEN the robot drives for a long time
    const Kidnapping one = kidnap(world, RelocalisationSettings{}, 20.0, draws);
    // THEN its pose is never reported as found, and it is reported as ambiguous
    EXPECT_FALSE(one.found) << seed;
    EXPECT_TRUE(one.ambiguous) << seed;
  }
}

TEST(Relocaliser, IsToldByItsWhereaboutsWhichOfTwoTwinsItIs) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    // GIVEN the same map, and a robot at one end of the hall, so that the symmetric pose is at the other end
    RandomDraws draws(seed);
    KidnapWorld world = lamp_hall(draws, 0.0);
    world.map_sigma_m = 0.0;
    world.low_m = {6.0, -5.0};
    world.high_m = {9.0, 7.5};
    // WHEN the robot's position is known within 2 m
    world.reach_m = 2.0;
    const Kidnapping one = kidnap(world, RelocalisationSettings{}, 20.0, draws);
    // THEN it is relocalised at the true pose
    EXPECT_TRUE(one.found) << seed;
    EXPECT_FALSE(one.wrong) << seed << ": " << one.error_m << " m off";
  }
}

TEST(Relocaliser, IsToldByAMissingLampWhichEndOfTheHallItIsIn) {
  int found = 0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    RandomDraws draws(seed);
    KidnapWorld world = lamp_hall(draws, 0.0);
    world.map_sigma_m = 0.02;
    world.truth.erase(world.truth.begin() + 5);
    world.low_m.x() = 12.0;
    world.high_m.x() = 24.0;
    const Kidnapping one = kidnap(world, RelocalisationSettings{}, 30.0, draws);
    found += one.found ? 1 : 0;
    EXPECT_FALSE(one.wrong) << seed;
  }
  EXPECT_GE(found, 2);
}

TEST(Relocaliser, TakesWhateverItIsGiven) {
  RandomDraws draws(5);
  std::vector<KnownLandmark> known = lab(draws).truth;
  known[3].p_map_m.x() = kNan;
  known[4].covariance_m2(0, 0) = std::numeric_limits<double>::infinity();
  std::vector<SeenDirection> clutter;
  for (int i = 0; i < 500; ++i)
    clutter.push_back(
        {.azimuth_rad = i % 50 == 0 ? kNan : draws.uniform(-kPi, kPi), .sigma_rad = i % 49 == 0 ? 0.0 : 0.02});
  Motion step;
  step.T_start_end.x_m = step.path_m = 0.2;
  for (const std::size_t landmarks : {0, 1, 2, 24})
    for (const std::size_t directions : {0, 1, 2, 500}) {
      Relocaliser relocaliser(RelocalisationSettings{});
      relocaliser.start(std::span(known).first(landmarks), CameraView{});
      for (int image = 0; image < 4; ++image) {
        relocaliser.update(std::span(clutter).first(directions));
        relocaliser.predict(step);
      }
      EXPECT_FALSE(relocaliser.found()) << landmarks << " landmarks, " << directions << " directions";
    }
}

TEST(Relocaliser, SaysTheSameTwice) {
  const auto once = [] {
    RandomDraws draws(6);
    const KidnapWorld world = lab(draws);
    const Kidnapping one = kidnap(world, RelocalisationSettings{}, 5.0, draws);
    return std::array{one.after_s, one.error_m, one.error_rad};
  };
  EXPECT_EQ(once(), once());
}

}  // namespace
}  // namespace azimuth
