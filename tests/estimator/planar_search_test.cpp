// Evidence of an image for or against the estimated pose of the robot.

#include "slam/planar/planar_search.hpp"

#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "slam/lost/lost_robot.hpp"

namespace azimuth {
namespace {

constexpr int kLandmarks = 10;
constexpr double kRange_m = 5.0;

/// A robot at the origin of a map whose landmarks differ only by colour, all seen a moment ago.
class SeenAmong : public ::testing::Test {
 protected:
  /// Places landmarks at the azimuths, with colours in turn.
  void place(const std::vector<double>& azimuths_rad) {
    MapSnapshot map;
    for (const double azimuth_rad : azimuths_rad)
      map.landmarks.push_back(
          {.p_map_landmark_m = {kRange_m * std::cos(azimuth_rad), kRange_m * std::sin(azimuth_rad)}});
    map.covariance.resize(map.entries());
    for (std::size_t i = 0; i < map.entries(); ++i) map.covariance(i, i) = 1e-6;
    const std::vector<Index> blocks = ekf_.restore(map);
    for (std::size_t i = 0; i < blocks.size(); ++i)
      landmarks_.push_back(
          {.id = static_cast<std::int64_t>(i), .kind = kind_of(i), .block = blocks[i], .sightings = 9});
  }
  static Kind kind_of(std::size_t landmark) { return static_cast<Kind>(landmark % 3); }

  static std::vector<double> all_round() {
    std::vector<double> azimuths_rad;
    for (int i = 0; i < kLandmarks; ++i) azimuths_rad.push_back(0.6 * i - 2.7);
    return azimuths_rad;
  }

  static Rig colour_rig() {
    Rig rig;
    rig.front_end = FrontEnd::colour;
    rig.camera.sigma_bearing_rad = 0.005;
    rig.camera.identities = false;
    return rig;
  }

  static EkfSettings settings() {
    EkfSettings settings;
    settings.probation.confirm_after_sightings = 8;
    return settings;
  }

  ImageAgreement agreement(const std::vector<Bearing>& bearings, Stamp stamp = {}, bool in_doubt = false) {
    return search_.agreement({.stamp = stamp, .bearings = bearings}, landmarks_, PlanarView(ekf_, rig_.camera), 0.0,
                             in_doubt);
  }

  Rig rig_ = colour_rig();
  PlanarSearch search_{rig_, settings(), RelocalisationSettings{}};
  BearingEkf ekf_{BearingEkfSettings{}};
  std::vector<PlanarLandmark> landmarks_;
};

TEST_F(SeenAmong, EachThatIsWhereItShouldBeIsExplained) {
  place(all_round());
  std::vector<Bearing> bearings;
  for (std::size_t i = 0; i < 4; ++i) bearings.push_back({.azimuth_rad = all_round()[i], .kind = kind_of(i)});
  bearings.push_back({.azimuth_rad = all_round()[5] + 0.1, .kind = kind_of(5)});
  const ImageAgreement agreed = agreement(bearings);
  EXPECT_EQ(agreed.expected, kLandmarks);
  EXPECT_EQ(agreed.bearings, 5);
  EXPECT_EQ(agreed.explained, 4);
}

TEST_F(SeenAmong, WhatStandsBehindAnotherIsNotMissed) {
  std::vector<double> azimuths_rad = all_round();
  azimuths_rad[1] = azimuths_rad[0] + 0.02;
  azimuths_rad[9] = azimuths_rad[8] + 0.02;
  place(azimuths_rad);
  EXPECT_EQ(agreement({{.azimuth_rad = azimuths_rad[4], .kind = kind_of(4)}}).expected, kLandmarks - 4);
}

TEST_F(SeenAmong, WhatIsSeenThereSpeaksForNothing) {
  std::vector<double> azimuths_rad = all_round();
  azimuths_rad[0] = kPi - 0.005;
  azimuths_rad[1] = -kPi + 0.005;
  place(azimuths_rad);
  const ImageAgreement agreed =
      agreement({{.azimuth_rad = azimuths_rad[0], .kind = kind_of(0)}, {.azimuth_rad = 0.0, .kind = kind_of(4)}});
  EXPECT_EQ(agreed.bearings, 1);
  EXPECT_EQ(agreed.explained, 0);
}

TEST_F(SeenAmong, WhatIsFartherThanWhatIsUsuallySeenIsNotMissed) {
  place(all_round());
  for (int i = 0; i < 1000; ++i) search_.note_range(i % 100 == 0 ? 7.0 : 1.0 + 0.03 * (i % 100));
  EXPECT_LT(search_.usual_range_m(), 0.95 * kRange_m);
  EXPECT_EQ(agreement({{.azimuth_rad = all_round()[4] + 0.1, .kind = kind_of(4)}}).expected, 0);
}

TEST_F(SeenAmong, UsuallySeenAreNineteenOfTwenty) {
  for (int i = 0; i < 5000; ++i) search_.note_range(1.0 + 0.01 * ((37 * i) % 100));
  EXPECT_NEAR(search_.usual_range_m(), 1.95, 0.1);
}

TEST_F(SeenAmong, WhatWentOutOfSightBeforeAnyDoubtIsNotMissed) {
  place(all_round());
  const auto at = [](int image) { return Stamp(std::chrono::seconds(image)); };
  constexpr int kImages = 20;
  for (std::size_t i = 0; i < kLandmarks; ++i) landmarks_[i].last_used = at(i < 3 ? 2 : kImages);
  for (int image = 1; image <= kImages; ++image) agreement({{.azimuth_rad = 0.3, .kind = kind_of(0)}}, at(image));
  EXPECT_EQ(agreement({{.azimuth_rad = 0.3, .kind = kind_of(0)}}, at(kImages + 1)).expected, kLandmarks - 3);
  // A doubt lasts until it is settled: the landmarks seen before the doubt remain expected.
  for (int image = 1; image <= kImages; ++image)
    agreement({{.azimuth_rad = 0.3, .kind = kind_of(0)}}, at(kImages + image), true);
  EXPECT_EQ(agreement({{.azimuth_rad = 0.3, .kind = kind_of(0)}}, at(3 * kImages), true).expected, kLandmarks - 3);
}

TEST_F(SeenAmong, WhereNothingIsDueWhatIsWhereItShouldBeSpeaksForThePose) {
  place(all_round());
  for (PlanarLandmark& landmark : landmarks_) landmark.last_used_m = -100.0;
  const ImageAgreement agreed = agreement({{.azimuth_rad = all_round()[0], .kind = kind_of(0)},
                                           {.azimuth_rad = all_round()[4], .kind = kind_of(4)},
                                           {.azimuth_rad = all_round()[5] + 0.1, .kind = kind_of(5)}});
  EXPECT_EQ(agreed.expected, 2);
  EXPECT_EQ(agreed.explained, 2);
  EXPECT_GT(agreed.chance, 0.0);
}

TEST_F(SeenAmong, FewLandmarksSayNothing) {
  place({0.0, 1.0, 2.0, 3.0, -1.0});
  EXPECT_EQ(agreement({{.azimuth_rad = 0.5, .kind = 0}}).expected, 0);
}

TEST_F(SeenAmong, ThingsAllAlikeSayNothing) {
  place(all_round());
  EXPECT_EQ(agreement({{.azimuth_rad = all_round()[4], .kind = kAnyKind}}).expected, 0);
}

TEST(AgreementWatch, OneLandmarkMissedAgainAndAgainIsNoDoubt) {
  AgreementWatch watch{RelocalisationSettings{}};
  for (int image = 0; image < 100; ++image) {
    watch.add({.expected = 1, .bearings = 6, .explained = 0, .chance = 0.05});
    EXPECT_FALSE(watch.doubts());
  }
  for (int image = 0; image < 10; ++image) watch.add({.expected = 2, .bearings = 6, .explained = 0, .chance = 0.05});
  EXPECT_TRUE(watch.is_lost());
}

}  // namespace
}  // namespace azimuth
