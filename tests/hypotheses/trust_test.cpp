#include "slam/hypotheses/trust.hpp"

#include <gtest/gtest.h>

#include "slam/hypotheses/nameless.hpp"
#include "tests/hypotheses/nameless_world.hpp"

namespace azimuth {
namespace {

TrustEvidence good() {
  TrustEvidence evidence;
  evidence.landmarks = 8;
  evidence.explained = 0.8;
  evidence.images = 20;
  evidence.recent_chi2 = 0.3;
  evidence.odometry_chi2 = 2.0;
  return evidence;
}

TEST(Trust, WithoutDoubtThereIsNoReason) {
  EXPECT_TRUE(trust(good()).trusted());
  EXPECT_EQ(trust(good()).doubt, "");
}

TEST(Trust, EachDoubtHasItsReason) {
  TrustEvidence evidence = good();
  evidence.landmarks = 0;
  EXPECT_EQ(trust(evidence).doubt, "no landmark found yet");
  evidence = good();
  evidence.narrow_view = true;
  EXPECT_EQ(trust(evidence).doubt, "too few landmarks at once to tell them apart");
  EXPECT_GT(probability_all_wrong(evidence), probability_all_wrong(good()));
  evidence = good();
  evidence.images = 5;
  EXPECT_EQ(trust(evidence).doubt, "too little seen yet to tell");
  evidence.from_saved_map = true;
  EXPECT_TRUE(trust(evidence).trusted());
  evidence = good();
  evidence.elsewhere = 0.5;
  EXPECT_EQ(trust(evidence).doubt, "several maps explain what was seen");
  evidence = good();
  evidence.spread = 4.0;
  EXPECT_EQ(trust(evidence).doubt, "several maps explain what was seen");
  evidence = good();
  evidence.odometry_chi2 = 12.0;
  EXPECT_EQ(trust(evidence).doubt, "the map contradicts the odometry");
  evidence = good();
  evidence.explained = 0.1;
  EXPECT_EQ(trust(evidence).doubt, "the map explains too little of what is seen");
  evidence = good();
  evidence.recent_chi2 = 1.0;
  EXPECT_EQ(trust(evidence).doubt, "the map bends what odometry says");
  evidence = good();
  evidence.missing = 0.6;
  EXPECT_EQ(trust(evidence).doubt, "landmarks that should be seen are missing");
}

TEST(Trust, AMapThatWasMostlyInDoubtIsInDoubtStill) {
  TrustEvidence contradicted = good();
  contradicted.odometry_chi2 = 12.0;
  RecentDoubts recent;
  EXPECT_TRUE(trust(good(), recent).trusted());
  for (int i = 0; i < 36; ++i) recent.add(contradicted);
  int images = 0;
  for (; !trust(good(), recent).trusted() && images < 100; ++images) {
    EXPECT_EQ(trust(good(), recent).doubt, "the map was in doubt too often lately");
    EXPECT_EQ(trust(contradicted, recent).doubt, "the map contradicts the odometry") << "the plainer reason";
    recent.add(good());
  }
  EXPECT_EQ(images, 12) << "a third of 36";
}

TEST(Trust, UpToTwoThirdsOfTheImagesMayBeInDoubt) {
  TrustEvidence contradicted = good();
  contradicted.odometry_chi2 = 12.0;
  RecentDoubts recent;
  for (int i = 0; i < 10; ++i) recent.add(good());
  for (int i = 0; i < 20; ++i) recent.add(contradicted);
  EXPECT_TRUE(trust(good(), recent).trusted()) << "20 of 30";
  recent.add(contradicted);
  EXPECT_FALSE(trust(good(), recent).trusted());
}

TEST(Trust, ImagesTooEarlyToTellAreNotCounted) {
  TrustEvidence early = good();
  early.images = 5;
  RecentDoubts recent;
  for (int i = 0; i < 20; ++i) recent.add(early);
  EXPECT_TRUE(trust(good(), recent).trusted());
}

TEST(Trust, AMapIsTheLikelierWrongTheLessItExplains) {
  TrustEvidence evidence = good();
  double last = 1.0;
  for (const double explained : {0.0, 0.1, 0.3, 0.6, 0.8}) {
    evidence.explained = explained;
    const double wrong = probability_all_wrong(evidence);
    EXPECT_TRUE(explained == 0.0 ? wrong == 1.0 : wrong < last);
    last = wrong;
  }
  EXPECT_GT(last, 0.05);
  evidence.explained = 1.0;  // the probability of being wrong has a floor
  EXPECT_EQ(probability_all_wrong(evidence), last);
}

TEST(Trust, AMapThatWentOnFittingIsHardlyWrong) {
  TrustEvidence evidence = good();
  const double young = probability_all_wrong(evidence);
  evidence.images = 360;
  EXPECT_LT(probability_all_wrong(evidence), 0.4 * young);
  evidence.explained = 0.3;  // a map that explains so little is wrong about half of the time, however old it is
  EXPECT_GT(probability_all_wrong(evidence), young);
}

TEST(Trust, OdometryHasASayWhereItIsNeitherSurelyRightNorSurelyWrong) {
  TrustEvidence evidence = good();
  const double said = share_of_odometry(evidence);
  EXPECT_GT(said, 0.02);
  EXPECT_LE(said, 0.25);
  evidence.images = 360;
  EXPECT_NEAR(share_of_odometry(evidence), 0.1 * said, 1e-12) << "the map is old";
  evidence = good();
  evidence.odometry_chi2 = 1e3;
  EXPECT_LT(share_of_odometry(evidence), 1e-6) << "the wheels slipped, or the map is wrong altogether";
}

TEST(Trust, AMapIsTheLikelierWrongTheFurtherItLiesOffOdometry) {
  TrustEvidence evidence = good();
  double last = 0.0;
  for (const double chi2 : {0.0, 1.0, 4.0, 9.0, 25.0, 1e5}) {
    evidence.odometry_chi2 = chi2;
    const double wrong = probability_all_wrong(evidence);
    EXPECT_GT(wrong, last);
    EXPECT_LE(wrong, 1.0);
    last = wrong;
  }
  EXPECT_GT(last, 0.99);
}

NamelessSettings two_members() {
  NamelessSettings settings;
  settings.beam.hypothesis = world_settings();
  settings.beam.members = 2;
  return settings;
}

/// Drives `images` images on the circle. Odometry turns by `too_far_rad` too far each time.
Nameless driven_nameless(int images, double too_far_rad) {
  InTurn workers;
  Nameless nameless(two_members());
  NamelessWorld world(ring_of_landmarks());
  for (int i = 0; i < images; ++i) {
    const Pose2 T = on_circle(i);
    if (i > 0) {
      Motion motion = world.motion(on_circle(i - 1), T);
      motion.T_start_end.heading_rad += too_far_rad;
      nameless.predict(motion);
    }
    BearingSet set;
    set.stamp = Stamp(duration_from_seconds(i));
    for (const NamelessSighting& sighting : world.sightings(T, 6.0))
      set.bearings.push_back({.azimuth_rad = sighting.azimuth_rad});
    nameless.update(set, workers);
  }
  return nameless;
}

TEST(Trust, BeginsWithTheFirstLandmark) {
  EXPECT_EQ(driven_nameless(2, 0.0).trust().doubt, "no landmark found yet");
  EXPECT_TRUE(driven_nameless(25, 0.0).trust().trusted());
}

TEST(Trust, WithoutAMapThePoseIsOdometrys) {
  const Nameless nameless = driven_nameless(2, 0.0);
  EXPECT_EQ(nameless.evidence().landmarks, 0);
  EXPECT_TRUE(nameless.pose().covariance.isApprox(nameless.odometry_alone().covariance));
}

TEST(Trust, ADarkCameraSpeaksNeitherForAMapNorAgainstIt) {
  InTurn workers;
  Nameless nameless = driven_nameless(25, 0.0);
  const double explained = nameless.evidence().explained;
  EXPECT_GT(explained, 0.5);
  NamelessWorld world(ring_of_landmarks());
  for (int i = 25; i < 45; ++i) {
    nameless.predict(world.motion(on_circle(i - 1), on_circle(i)));
    BearingSet dark;
    dark.stamp = Stamp(duration_from_seconds(i));
    EXPECT_TRUE(nameless.update(dark, workers));
  }
  EXPECT_NEAR(nameless.evidence().explained, explained, 0.1);
}

TEST(Trust, LandmarksThatAreNotSeenAnyMoreAreMissing) {
  InTurn workers;
  Nameless nameless = driven_nameless(25, 0.0);
  EXPECT_LT(nameless.evidence().missing, 0.4);
  EXPECT_TRUE(nameless.trust().trusted());
  NamelessWorld world(ring_of_landmarks());
  for (int i = 25; i < 37; ++i) {
    nameless.predict(world.motion(on_circle(i - 1), on_circle(i)));
    BearingSet few;
    few.stamp = Stamp(duration_from_seconds(i));
    const std::vector<NamelessSighting> all = world.sightings(on_circle(i), 6.0);
    ASSERT_GE(all.size(), 3U);
    few.bearings.push_back({.azimuth_rad = all.front().azimuth_rad});  // all landmarks in sight but one were removed
    nameless.update(few, workers);
  }
  EXPECT_GT(nameless.evidence().missing, 0.5);
  EXPECT_FALSE(nameless.trust().trusted());
}

TEST(Trust, AMapThatOdometryContradictsMakesThePoseVague) {
  const Nameless steady = driven_nameless(25, 0.0), turned = driven_nameless(25, 0.03);
  EXPECT_GT(turned.evidence().odometry_chi2, steady.evidence().odometry_chi2 + 5.0);
  EXPECT_GT(turned.pose().covariance.trace(), 2.0 * turned.beam().newest_pose().covariance.trace());
  EXPECT_FALSE(turned.trust().trusted());
}

TEST(Trust, NoCovarianceIsSmallerThanTheMembersHaveIt) {
  const Nameless nameless = driven_nameless(25, 0.0);
  const Eigen::Matrix3d more = nameless.pose().covariance - nameless.beam().newest_pose().covariance;
  EXPECT_GT(more(0, 0), 0.0);
  EXPECT_GT(more(1, 1), 0.0);
  // The covariance of odometry alone is the upper limit.
  EXPECT_LT(nameless.pose().covariance.trace(), 1.5 * nameless.odometry_alone().covariance.trace());
}

}  // namespace
}  // namespace azimuth
