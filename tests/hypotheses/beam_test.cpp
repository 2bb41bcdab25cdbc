#include "slam/hypotheses/beam.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/hypotheses/nameless_world.hpp"
#include "tests/support/threaded_workers.hpp"

namespace azimuth {
namespace {

constexpr int kImages = 20;

BeamSettings beam_settings() {
  BeamSettings settings;
  settings.hypothesis = world_settings();
  settings.members = 6;
  return settings;
}

std::vector<Pose2> poses_by(Workers& workers, Beam& beam) {
  NamelessWorld world(ring_of_landmarks(), 3);
  std::vector<Pose2> poses;
  beam.begin(world.sightings(on_circle(0), 6.0));
  for (int i = 1; i < kImages; ++i) {
    const Motion motion = world.motion(on_circle(i - 1), on_circle(i));
    beam.add_image(motion, world.sightings(on_circle(i), 6.0), workers);
    poses.push_back(beam.newest_pose().T_map_body);
  }
  return poses;
}

TEST(Beam, SameBitsOnAnyNumberOfThreads) {
  InTurn in_turn;
  ThreadedWorkers two(2), five(5);
  Beam alone(beam_settings()), of_two(beam_settings()), of_five(beam_settings());
  const std::vector<Pose2> poses = poses_by(in_turn, alone);
  EXPECT_EQ(poses, poses_by(two, of_two));
  EXPECT_EQ(poses, poses_by(five, of_five));
  EXPECT_EQ(alone.best_energy(), of_two.best_energy());
  EXPECT_EQ(alone.newest_pose().covariance, of_five.newest_pose().covariance);
}

TEST(Beam, ThePoseIsRightWithinWhatItSaysOfItself) {
  InTurn in_turn;
  Beam beam(beam_settings());
  const Pose2 last = poses_by(in_turn, beam).back();
  const Pose2 truth = inverse(on_circle(0)) * on_circle(kImages - 1);
  Eigen::Vector3d off = truth.vector() - last.vector();
  off.z() = wrap(off.z());
  EXPECT_LT(off.dot(beam.newest_pose().covariance.inverse() * off), 16.3);  // 99.9 % quantile of 3 degrees of freedom
  EXPECT_LT(off.head<2>().norm(), 0.15);
}

TEST(Beam, MembersDiffer) {
  const std::vector<MemberSettings> members = differing_members(16);
  for (std::size_t i = 0; i < members.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(members[i], members[j]) << i << " and " << j;
}

TEST(Beam, CopiesOfAHypothesisShareWhatTheyHaveInCommon) {
  NamelessWorld world(ring_of_landmarks());
  Hypothesis hypothesis = driven(world, 10);
  const Hypothesis copy = hypothesis;
  EXPECT_EQ(&hypothesis.graph().bearing(0), &copy.graph().bearing(0));
  const LandmarkId landmark = hypothesis.landmarks().front();
  EXPECT_EQ(&hypothesis.graph().landmark(landmark), &copy.graph().landmark(landmark));
  const BearingId bearing = hypothesis.graph().bearings_of(landmark).back();
  hypothesis.assign(bearing, kOfNothing);
  EXPECT_EQ(copy.graph().landmark_of(bearing), landmark);
}

}  // namespace
}  // namespace azimuth
