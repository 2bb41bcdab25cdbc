// A hall of lamps, driven in two halves and mapped separately, compared with one long drive through all of it.

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "slam/ceiling/lamp_ekf_estimator.hpp"
#include "slam/geometry/rigid_alignment.hpp"
#include "slam/map_merge/merge_maps.hpp"
#include "tests/geometry/random_draws.hpp"
#include "tests/support/lamp_run.hpp"

namespace azimuth::test {
namespace {

constexpr double kStride_m = 0.265, kHalfDepth_m = 5.0;

/// Rounds along an ellipse in the hall.
std::vector<Pose2> rounds(double middle_x_m, double half_width_m) {
  std::vector<Pose2> path;
  for (double t = -std::numbers::pi / 2.0; t < 2.2 * 2.0 * std::numbers::pi;) {
    const double dx = -half_width_m * std::sin(t), dy = kHalfDepth_m * std::cos(t);
    path.push_back({middle_x_m + half_width_m * std::cos(t), 1.25 + kHalfDepth_m * std::sin(t), std::atan2(dy, dx)});
    t += kStride_m / std::hypot(dx, dy);
  }
  return path;
}

std::vector<Eigen::Vector3d> lamps_of(unsigned seed) {
  RandomDraws draws(seed);
  std::vector<Eigen::Vector3d> lamps;
  for (double x = 4.5; x < 68.0; x += 9.0)
    for (const double y : {-5.5, -1.0, 3.5, 8.0})
      lamps.emplace_back(x + draws.uniform(-1.2, 1.2), y + draws.uniform(-1.2, 1.2), 6.5);
  return lamps;
}

MapSnapshot mapped(const std::vector<Eigen::Vector3d>& lamps, const std::vector<Pose2>& path, std::uint64_t seed) {
  const LampRun run = driven_hall(lamps, path, seed);
  LampEkfEstimator estimator(run.rig, {});
  for (std::size_t i = 0; i < run.sets.size(); ++i) {
    estimator.predict(run.motions[i]);
    estimator.update(run.sets[i]);
  }
  MapSnapshot map;
  EXPECT_TRUE(estimator.save_map(map));
  return map;
}

struct LampError {
  double sum_m2 = 0.0;
  std::size_t lamps = 0;
  double rms_m() const { return std::sqrt(sum_m2 / static_cast<double>(lamps)); }
};

/// Adds the errors of the mapped lamps after the best rigid alignment. `start` is an approximate alignment of the map
/// with the world.
void judge(const MapSnapshot& map, const std::vector<Eigen::Vector3d>& lamps, const Pose2& start, LampError& error) {
  Pose2 T_world_map = start;
  std::vector<Eigen::Vector2d> in_map, in_world;
  for (int turn = 0; turn < 3; ++turn) {
    in_map.clear();
    in_world.clear();
    for (const Eigen::Vector3d& lamp : lamps) {
      const auto off_m = [&](const MapLandmark& l) {
        return (T_world_map * l.p_map_landmark_m - lamp.head<2>()).norm();
      };
      const MapLandmark& nearest = *std::ranges::min_element(map.landmarks, {}, off_m);
      if (off_m(nearest) > kMapped_m) continue;
      in_map.push_back(nearest.p_map_landmark_m);
      in_world.emplace_back(lamp.head<2>());
    }
    T_world_map = align(in_map, in_world);
  }
  for (std::size_t i = 0; i < in_map.size(); ++i) error.sum_m2 += (T_world_map * in_map[i] - in_world[i]).squaredNorm();
  error.lamps += in_map.size();
}

TEST(HallHalves, MergedAreAsGoodAsOneLongDrive) {
  LampError apart, whole;
  const std::vector<Pose2> left = rounds(23.0, 13.0), right = rounds(45.0, 13.0), all = rounds(34.0, 24.0);
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const std::vector<Eigen::Vector3d> lamps = lamps_of(seed);
    const MapSnapshot a = mapped(lamps, left, 100 + seed), b = mapped(lamps, right, 200 + seed);
    const MergedMaps merged = merge_maps(a, b);
    ASSERT_EQ(merged.refusal, MergeRefusal::none) << "seed " << seed << ", log odds " << merged.log_odds;
    EXPECT_GE(merged.map.landmarks.size() + 3, lamps.size()) << "seed " << seed;
    EXPECT_LE(merged.map.landmarks.size(), lamps.size() + 2) << "seed " << seed;
    judge(merged.map, lamps, left.front(), apart);
    judge(mapped(lamps, all, 300 + seed), lamps, all.front(), whole);
  }
  std::printf("lamps: halves merged %.3f m (%zu), one long drive %.3f m (%zu), ratio %.2f\n", apart.rms_m(),
              apart.lamps, whole.rms_m(), whole.lamps, apart.rms_m() / whole.rms_m());
  EXPECT_LE(apart.rms_m(), 1.2 * whole.rms_m());
  EXPECT_GE(apart.lamps + 8, whole.lamps) << "and they are all there";
}

TEST(HallHalves, OfTwoHallsAreRefused) {
  const std::vector<Pose2> left = rounds(23.0, 13.0), right = rounds(45.0, 13.0);
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const MapSnapshot a = mapped(lamps_of(seed), left, 100 + seed), b = mapped(lamps_of(50 + seed), right, 200 + seed);
    const MergedMaps merged = merge_maps(a, b);
    EXPECT_EQ(merged.refusal, MergeRefusal::no_overlap) << "seed " << seed << ", log odds " << merged.log_odds;
  }
}

}  // namespace
}  // namespace azimuth::test
