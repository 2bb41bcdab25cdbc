#include "slam/hypotheses/nameless.hpp"

#include <Eigen/LU>
#include <cstdio>
#include <gtest/gtest.h>
#include <vector>

#include "tests/hypotheses/nameless_world.hpp"

namespace azimuth {
namespace {

NamelessSettings nameless_settings() {
  NamelessSettings settings;
  settings.beam.hypothesis = world_settings();
  settings.beam.members = 2;
  return settings;
}

BearingSet set_at(double t_s) {
  BearingSet set;
  set.stamp = Stamp(duration_from_seconds(t_s));
  set.bearings.push_back({.azimuth_rad = 0.3});
  return set;
}

Motion ahead(double distance_m) {
  Motion motion;
  append(motion, Control{distance_m, 0.0, 0.0}, Control{distance_m, 0.0, 0.0}, {2.5e-3, 1e-3, 1e-4, 0.0});
  return motion;
}

TEST(Nameless, AnImageThatComesTooSoonOrWhileTheRobotStandsMakesNoPose) {
  InTurn workers;
  Nameless nameless(nameless_settings());
  EXPECT_TRUE(nameless.update(set_at(0.0), workers));
  nameless.predict(ahead(0.1));
  EXPECT_FALSE(nameless.update(set_at(0.1), workers));
  EXPECT_NEAR(nameless.pose().T_map_body.x_m, 0.1, 1e-12);
  nameless.predict(ahead(0.4));
  EXPECT_TRUE(nameless.update(set_at(0.5), workers));
  EXPECT_NEAR(nameless.pose().T_map_body.x_m, 0.5, 1e-9);
  nameless.predict(Motion{});
  EXPECT_FALSE(nameless.update(set_at(5.0), workers));
  EXPECT_EQ(nameless.anchor(), 1);
}

TEST(Nameless, AnImageThatComesSoonButFromFarAwayMakesAPose) {
  InTurn workers;
  Nameless nameless(nameless_settings());
  nameless.update(set_at(0.0), workers);
  nameless.predict(ahead(0.35));
  EXPECT_TRUE(nameless.update(set_at(0.1), workers));
}

/// The number of landmarks after an image of two bearings `apart_sigmas` apart, when each bearing becomes a landmark at
/// once.
int landmarks_of_two(double apart_sigmas) {
  NamelessSettings settings = nameless_settings();
  settings.beam.hypothesis.tracks.used = true;
  BearingSet set = set_at(0.0);
  set.bearings.push_back(set.bearings.front());
  set.bearings.back().azimuth_rad += apart_sigmas * settings.beam.hypothesis.scene.sigma_bearing_rad;
  InTurn workers;
  Nameless nameless(settings);
  nameless.update(set, workers);
  return static_cast<int>(nameless.beam().best().landmarks().size());
}

TEST(Nameless, OnlyBearingsThatNobodyCouldTellApartAreOneWhereEachIsALandmark) {
  EXPECT_EQ(landmarks_of_two(0.5), 1);
  EXPECT_EQ(landmarks_of_two(0.9), 2);
}

TEST(BelievedPose, OneOfTwoIsTheMixtureOfBothWhereverItIsTold) {
  BelievedPose first, second;
  first.T_map_body = {1.0, 2.0, 3.1};
  first.covariance.diagonal() << 0.1, 0.2, 0.03;
  second.T_map_body = {3.0, 1.0, -3.1};  // farther round across the wrap at pi
  second.covariance.diagonal() << 0.5, 0.4, 0.01;
  constexpr double kWrong = 0.3;
  const BelievedPose told = one_of_two(first, second, kWrong, kWrong);
  const BelievedPose expected =
      mixture(std::vector{first, second}, std::vector{1.0 - kWrong, kWrong}, first.T_map_body);
  EXPECT_LT(pose_difference(told.T_map_body, expected.T_map_body).norm(), 1e-12);
  EXPECT_LT((told.covariance - expected.covariance).norm(), 1e-12);

  const BelievedPose first_told = one_of_two(first, second, kWrong, 0.0);
  const Eigen::Vector3d off = pose_difference(expected.T_map_body, first.T_map_body);
  EXPECT_LT((first_told.T_map_body.vector() - first.T_map_body.vector()).norm(), 1e-12);
  EXPECT_LT((first_told.covariance - expected.covariance - off * off.transpose()).norm(), 1e-12);
}

TEST(Nameless, NamesAreNotLookedAt) {
  InTurn workers;
  Nameless with(nameless_settings()), without(nameless_settings());
  NamelessWorld world(ring_of_landmarks()), same(ring_of_landmarks());
  for (int i = 0; i < 8; ++i) {
    if (i > 0) {
      with.predict(world.motion(on_circle(i - 1), on_circle(i)));
      without.predict(same.motion(on_circle(i - 1), on_circle(i)));
    }
    BearingSet named, nameless;
    named.stamp = nameless.stamp = Stamp(duration_from_seconds(i));
    for (const NamelessSighting& s : world.sightings(on_circle(i), 6.0))
      named.bearings.push_back({.azimuth_rad = s.azimuth_rad, .identity = 5});
    for (const NamelessSighting& s : same.sightings(on_circle(i), 6.0))
      nameless.bearings.push_back({.azimuth_rad = s.azimuth_rad});
    with.update(named, workers);
    without.update(nameless, workers);
  }
  EXPECT_EQ(with.pose().T_map_body, without.pose().T_map_body);
}

/// The bearings of an image on the circle; a lap takes somewhat more than 31 images.
BearingSet lap_set(NamelessWorld& world, int image) {
  BearingSet set;
  set.stamp = Stamp(duration_from_seconds(image));
  for (const NamelessSighting& s : world.sightings(on_circle(image), 6.0))
    set.bearings.push_back({.azimuth_rad = s.azimuth_rad});
  return set;
}

TEST(Nameless, OfALongDriveSoManyImagesAreKept) {
  constexpr int kKept = 60, kDriven = 150;
  NamelessSettings settings = nameless_settings();
  settings.max_keyframes = kKept;
  InTurn workers;
  Nameless nameless(settings);
  NamelessWorld world(ring_of_landmarks());
  std::vector<double> azimuths_rad;
  for (int i = 0; i < kDriven; ++i) {
    if (i > 0) nameless.predict(world.motion(on_circle(i - 1), on_circle(i)));
    const BearingSet set = lap_set(world, i);
    for (const Bearing& bearing : set.bearings) azimuths_rad.push_back(bearing.azimuth_rad);
    nameless.update(set, workers);
    if (nameless.is_full()) nameless.forget(workers);
    ASSERT_LE(nameless.numbers().size(), static_cast<std::size_t>(kKept));
    ASSERT_EQ(nameless.anchor(), i);
  }
  const Hypothesis& best = nameless.beam().best();
  EXPECT_EQ(best.landmarks().size(), ring_of_landmarks().size());
  for (BearingId id = 0; id < best.graph().bearings(); ++id)
    EXPECT_EQ(best.graph().bearing(id).azimuth_rad, azimuths_rad[static_cast<std::size_t>(nameless.number_of(id))]);
  EXPECT_EQ(nameless.bearings_so_far(), static_cast<std::int64_t>(azimuths_rad.size()));

  double squares = 0.0;
  for (int i = 1; i < kDriven; ++i) {
    const Beam::PoseBelief past = nameless.past(i);
    Eigen::Vector3d off = (inverse(on_circle(0)) * on_circle(i)).vector() - past.T_map_body.vector();
    off.z() = wrap(off.z());
    EXPECT_LT(off.head<2>().norm(), 0.3) << i;
    squares += off.dot(past.covariance.inverse() * off);
  }
  const double anees = squares / (kDriven - 1);
  std::printf("ANEES of the past %.2f\n", anees);
  EXPECT_LT(anees, 6.0);
}

}  // namespace
}  // namespace azimuth
