#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <numbers>

#include "slam/hypotheses/drawn_map.hpp"
#include "tests/hypotheses/nameless_world.hpp"
#include "tests/support/threaded_workers.hpp"

namespace azimuth {
namespace {

DrawnMapsSettings settings_of_few() {
  DrawnMapsSettings settings;
  settings.map.hypothesis = world_settings();
  settings.map.hypothesis.scene.field_of_view_rad = std::numbers::pi / 2.0;
  settings.populations = 4;
  settings.members = 5;
  return settings;
}

std::vector<NamelessSighting> ahead(std::vector<NamelessSighting> sightings) {
  std::erase_if(sightings, [](const NamelessSighting& s) { return std::abs(s.azimuth_rad) > std::numbers::pi / 4.0; });
  return sightings;
}

/// The pose after every image, and the final pose of odometry alone.
struct Drive {
  std::vector<BelievedPose> beliefs;
  Pose2 by_odometry;
};
Drive driven(Workers& workers, int images, unsigned seed = 1) {
  NamelessWorld world(ring_of_landmarks(), seed);
  DrawnMaps maps(settings_of_few());
  maps.begin(ahead(world.sightings(on_circle(0), 6.0)), workers);
  Drive drive{{maps.pose()}, {}};
  for (int i = 1; i < images; ++i) {
    const Motion motion = world.motion(on_circle(i - 1), on_circle(i));
    drive.by_odometry = drive.by_odometry * motion.T_start_end;
    maps.add_image(motion, ahead(world.sightings(on_circle(i), 6.0)), workers, 0.5);
    drive.beliefs.push_back(maps.pose());
  }
  return drive;
}

TEST(DrawnMaps, SameBitsWhateverTheWorkers) {
  InTurn one;
  ThreadedWorkers several(3);
  const auto alone = driven(one, 70).beliefs, together = driven(several, 70).beliefs;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_EQ(alone[i].T_map_body, together[i].T_map_body) << i;
    EXPECT_EQ(alone[i].covariance, together[i].covariance) << i;
  }
}

/// The mean over ten drives of three laps.
TEST(DrawnMaps, KnowBetterThanOdometryWhereTheRobotIs) {
  InTurn workers;
  constexpr int kThreeLaps = 95;
  const Pose2 truth = inverse(on_circle(0)) * on_circle(kThreeLaps - 1);
  double drawn_m2 = 0.0, odometry_m2 = 0.0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Drive drive = driven(workers, kThreeLaps, seed);
    drawn_m2 += (drive.beliefs.back().T_map_body.position() - truth.position()).squaredNorm();
    odometry_m2 += (drive.by_odometry.position() - truth.position()).squaredNorm();
  }
  std::printf("off by %.2f times what odometry is off by\n", std::sqrt(drawn_m2 / odometry_m2));
  EXPECT_LT(drawn_m2, 0.25 * odometry_m2);
}

TEST(DrawnMaps, BeginWhereTheMapBegins) {
  InTurn workers;
  DrawnMaps maps(settings_of_few());
  maps.begin({}, workers);
  EXPECT_EQ(maps.pose().T_map_body, Pose2{});
  EXPECT_EQ(maps.pose().covariance, Eigen::Matrix3d::Zero());
}

}  // namespace
}  // namespace azimuth
