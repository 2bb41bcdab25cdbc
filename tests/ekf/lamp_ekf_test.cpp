// The EKF over lamps in space: it estimates their positions, a turn of the whole map changes nothing, and it gains no
// information on the direction of the map.

#include "slam/ekf/lamp_ekf.hpp"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "tests/geometry/numeric_jacobian.hpp"
#include "tests/geometry/random_draws.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

using Retraction = JointState::Retraction;

constexpr double kCamera_m = 1.8, kSigmaLamp_rad = 0.005;
constexpr double kInverse_per_m = 0.277, kSigmaInverse_per_m = 0.123;

LampSeen seen_from(const Pose2& pose, const Eigen::Vector3d& lamp, RandomDraws& draws) {
  const Eigen::Vector2d m = predict_offset(pose, lamp, kCamera_m, 0.1)->m;
  const double sigma_azimuth_rad = kSigmaLamp_rad / std::max(0.02, std::sin(std::atan(m.norm())));
  return {TangentDirection(std::atan2(m.y(), m.x()) + draws.normal(sigma_azimuth_rad),
                           std::atan(m.norm()) + draws.normal(kSigmaLamp_rad),
                           {sigma_azimuth_rad * sigma_azimuth_rad, kSigmaLamp_rad * kSigmaLamp_rad})};
}

/// A drive below four lamps. It starts at `T_map_start` in the map.
struct Drive {
  explicit Drive(const Pose2& T_map_start, Retraction retraction = Retraction::invariant)
      : ekf({retraction, kCamera_m, 0.2}), truth(T_map_start) {
    ekf.place_robot(T_map_start, Eigen::Vector3d(1e-4, 1e-4, 1e-4).asDiagonal());
    for (const Eigen::Vector3d& lamp :
         {Eigen::Vector3d(3.0, 1.0, 6.5), {-1.0, 4.0, 5.0}, {6.0, -3.0, 6.5}, {0.2, 0.0, 4.0}}) {
      const Eigen::Vector2d turned = T_map_start * Eigen::Vector2d(lamp.head<2>());
      lamps.emplace_back(turned.x(), turned.y(), lamp.z());
    }
  }

  void step(RandomDraws& draws) {
    const Control control{0.2, 0.02, 0.03};
    const Control measured{0.2 + draws.normal(0.004), 0.02 + draws.normal(0.002), 0.03 + draws.normal(0.002)};
    truth = move(truth, control);
    Motion motion;
    motion.T_start_end = move({}, measured);
    motion.covariance = Eigen::Vector3d(1.6e-5, 1.6e-7, 8e-6).asDiagonal();
    motion.path_m = 0.2;
    ekf.predict(motion);
    sightings.clear();
    for (std::size_t i = 0; i < lamps.size(); ++i) {
      const LampSeen seen = seen_from(truth, lamps[i], draws);
      if (blocks.size() < lamps.size())
        blocks.push_back(ekf.add_lamp(seen, kInverse_per_m, kSigmaInverse_per_m));
      else
        sightings.push_back({blocks[i], seen});
    }
    EXPECT_TRUE(ekf.update(sightings));
  }

  LampEkf ekf;
  Pose2 truth;
  std::vector<Eigen::Vector3d> lamps;
  std::vector<LampBlock> blocks;
  std::vector<MappedLampSighting> sightings;
};

double squared_error(const LampPoint& point, const Eigen::Vector3d& truth) {
  const Eigen::Vector3d error = point.p_map_lamp_m - truth;
  return error.dot(point.covariance_m2.ldlt().solve(error));
}

TEST(LampEkf, FindsLampsFromTheirFirstSightingOnAndKnowsHowWell) {
  double sum = 0.0;
  constexpr int kSeeds = 40, kLamps = 4;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    RandomDraws draws(seed);
    Drive drive({});
    // the initial error that the filter assumes
    drive.truth = {draws.normal(0.01), draws.normal(0.01), draws.normal(0.01)};
    for (int i = 0; i < 30; ++i) drive.step(draws);
    for (std::size_t i = 0; i < kLamps; ++i) {
      EXPECT_LT((drive.ekf.point(drive.blocks[i]).p_map_lamp_m - drive.lamps[i]).norm(), 0.6);
      sum += squared_error(drive.ekf.point(drive.blocks[i]), drive.lamps[i]);
    }
  }
  const double anees = sum / (kSeeds * kLamps);
  std::printf("lamps after 6 m: ANEES %.2f of 3\n", anees);
  EXPECT_GT(anees, 2.0);
  EXPECT_LT(anees, 4.5);
}

TEST(LampEkf, MovingTheWholeMapChangesNothingElse) {
  RandomDraws poses(5);
  for (int trial = 0; trial < 10; ++trial) {
    const Pose2 T_new_old = poses.pose(50.0);
    RandomDraws same(9), again(9);
    Drive here({}), there(T_new_old);
    there.ekf.place_robot(T_new_old, Eigen::Vector3d(1e-4, 1e-4, 1e-4).asDiagonal());
    for (int i = 0; i < 15; ++i) {
      here.step(same);
      there.step(again);
      if (i == 9)
        for (Drive* drive : {&here, &there}) drive->ekf.promote(drive->blocks[0]);
    }
    const Pose2 moved = T_new_old * here.ekf.state().pose();
    EXPECT_LT((moved.position() - there.ekf.state().pose().position()).norm(), 1e-8);
    EXPECT_NEAR(wrap(moved.heading_rad - there.ekf.state().pose().heading_rad), 0.0, 1e-9);
    for (std::size_t i = 0; i < here.blocks.size(); ++i) {
      const LampPoint a = here.ekf.point(here.blocks[i]), b = there.ekf.point(there.blocks[i]);
      EXPECT_LT((T_new_old * Eigen::Vector2d(a.p_map_lamp_m.head<2>()) - b.p_map_lamp_m.head<2>()).norm(), 1e-7);
      EXPECT_NEAR(a.p_map_lamp_m.z(), b.p_map_lamp_m.z(), 1e-8);
      EXPECT_NEAR(a.covariance_m2.trace(), b.covariance_m2.trace(), 1e-7);
    }
  }
}

/// The information on a turn of the robot and the map together about the origin. No sighting depends on this turn, so
/// the information must not exceed that of the first pose.
double information_on_the_turn(const LampEkf& ekf, std::span<const LampBlock> lamps) {
  std::vector<Index> entries{0, 1, 2};
  Eigen::VectorXd N = Eigen::VectorXd::Zero(3 + 5 * static_cast<Index>(lamps.size()));
  const auto perpendicular = [](const Eigen::Vector2d& v) { return Eigen::Vector2d(-v.y(), v.x()); };
  N.head<2>() = perpendicular(ekf.state().position(0));
  N(2) = 1.0;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    const Index first = 3 + 5 * static_cast<Index>(i);
    for (Index k = 0; k < 5; ++k) entries.push_back(lamps[i].block + k);
    N.segment<2>(first) = perpendicular(ekf.state().position(lamps[i].block));
    N.segment<2>(first + 2) = perpendicular(ekf.state().position(lamps[i].block + 2));
  }
  Eigen::MatrixXd P(N.size(), N.size());
  ekf.state().covariance(entries, entries, P);
  return N.dot(P.ldlt().solve(N));
}

TEST(LampEkf, GainsNoInformationOnTheDirectionOfTheMap) {
  RandomDraws draws(11);
  Drive drive({1.0, 2.0, 0.3});
  // Each lamp gets an anchor of its own, because the covariance of a shared anchor would be singular.
  for (std::size_t i = 0; i < drive.lamps.size(); ++i) {
    drive.blocks.push_back(
        drive.ekf.add_lamp(seen_from(drive.truth, drive.lamps[i], draws), kInverse_per_m, kSigmaInverse_per_m));
    drive.ekf.inflate_robot(Eigen::Vector3d(1e-4, 1e-4, 0.0).asDiagonal());
  }
  const double before = information_on_the_turn(drive.ekf, drive.blocks);
  for (int i = 0; i < 20; ++i) {
    drive.step(draws);
    EXPECT_LE(information_on_the_turn(drive.ekf, drive.blocks), before * (1.0 + 1e-6));
  }
}

TEST(LampEkf, PromotionKeepsPlaceCovarianceAndPrediction) {
  RandomDraws draws(12);
  Drive drive({});
  for (int i = 0; i < 40; ++i) drive.step(draws);
  EXPECT_GT(drive.ekf.nonlinearity(drive.blocks[2]), 0.0);
  const LampPoint before = drive.ekf.point(drive.blocks[2]);
  const auto seen_before = drive.ekf.predict(drive.blocks[2]);
  const Eigen::Matrix2d S_before = drive.ekf.covariance(*seen_before, *seen_before);
  drive.ekf.promote(drive.blocks[2]);
  EXPECT_EQ(drive.blocks[2].kind, BlockKind::point3);
  const LampPoint after = drive.ekf.point(drive.blocks[2]);
  EXPECT_EQ(before.p_map_lamp_m, after.p_map_lamp_m);
  EXPECT_LT((before.covariance_m2 - after.covariance_m2).norm(), 1e-12);
  const auto seen_after = drive.ekf.predict(drive.blocks[2]);
  EXPECT_LT((seen_before->m - seen_after->m).norm(), 1e-12);
  EXPECT_LT((S_before - drive.ekf.covariance(*seen_after, *seen_after)).norm(), 1e-10);
}

TEST(LampEkf, MergingTwoEntriesOfOneLampIsWorthBothOfThem) {
  RandomDraws draws(13);
  Drive drive({});
  for (int i = 0; i < 40; ++i) drive.step(draws);
  // A second entry of the same lamp.
  LampBlock twin =
      drive.ekf.add_lamp(seen_from(drive.truth, drive.lamps[0], draws), kInverse_per_m, kSigmaInverse_per_m);
  for (int i = 0; i < 25; ++i) {
    drive.step(draws);
    EXPECT_TRUE(drive.ekf.update(std::array{MappedLampSighting{twin, seen_from(drive.truth, drive.lamps[0], draws)}}));
  }
  drive.ekf.promote(twin);
  for (LampBlock& lamp : drive.blocks) drive.ekf.promote(lamp);
  EXPECT_LT(drive.ekf.squared_distance(drive.blocks[0], twin), 16.0);
  EXPECT_GT(drive.ekf.squared_distance(drive.blocks[1], twin), 100.0);
  const double apart_before = drive.ekf.point(drive.blocks[0]).covariance_m2.trace();
  drive.ekf.merge(drive.blocks[0], twin);
  EXPECT_LT(drive.ekf.point(drive.blocks[0]).covariance_m2.trace(), apart_before);
  EXPECT_LT(squared_error(drive.ekf.point(drive.blocks[0]), drive.lamps[0]), 16.0);
}

TEST(LampEkf, DoesNotAllocateOnceTheMapStandsStill) {
  RandomDraws draws(14);
  Drive drive({});
  for (int i = 0; i < 5; ++i) drive.step(draws);
  const std::size_t before = allocations();
  for (int i = 0; i < 20; ++i) drive.step(draws);
  EXPECT_EQ(allocations(), before);
}

}  // namespace
}  // namespace azimuth
