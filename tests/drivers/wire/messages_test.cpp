// Messages must survive encoding and decoding unchanged.

#include "drivers/wire/messages.hpp"

#include <azimuth/pose_t.hpp>
#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <limits>
#include <random>

#include "tests/drivers/wire/sample_messages.hpp"

namespace azimuth {
namespace {

using namespace test;

TEST(Messages, OdometryComesBack) {
  const auto back = decode_odometry(encoded(to_message(kReading)));
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, kReading);
}

TEST(Messages, BearingsComeBack) {
  const auto back = decode_bearings(encoded(to_message(kSet)));
  ASSERT_TRUE(back);
  EXPECT_TRUE(test::same_bits(*back, kSet));
  EXPECT_TRUE(decode_bearings(encoded(to_message(BearingSet{})))) << "an image in which nothing was found";
}

TEST(Messages, FeaturesComeBackBitForBit) {
  for (const std::size_t count : {0U, 1U, 7U, 300U}) {
    BearingSet set = test::feature_set(count, 77);
    const auto expect_back = [&set] {
      const auto back = decode_features(encoded(to_features_message(set)));
      ASSERT_TRUE(back) << set.bearings.size();
      EXPECT_TRUE(test::same_bits(*back, set)) << set.bearings.size();
    };
    expect_back();
    set.neighbours.clear();
    expect_back();
    set.descriptors.clear();
    expect_back();
  }
}

TEST(Messages, EveryTroubleComesBack) {
  for (int trouble = 0; trouble < kImageTroubles; ++trouble) {
    const BearingSet set{.bearings = {}, .trouble = static_cast<ImageTrouble>(trouble)};
    const auto back = decode_features(encoded(to_features_message(set)));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->trouble, set.trouble);
  }
}

TEST(Messages, FullestFeaturesComeBack) {
  const BearingSet set = test::feature_set(features_t::MAX_FEATURES);
  features_t message;
  fill_message(test::feature_set(20), message);  // reuses the storage
  fill_message(set, message);
  const auto back = decode_features(encoded(message));
  ASSERT_TRUE(back);
  EXPECT_TRUE(test::same_bits(*back, set));
}

TEST(Messages, PlainIsWhatBearingsCanSay) {
  EXPECT_TRUE(is_plain(kSet));
  EXPECT_TRUE(is_plain(BearingSet{}));
  BearingSet kind = kSet, sigma = kSet, descriptors = kSet, neighbours = kSet, trouble;
  kind.bearings[1].kind = 0;
  sigma.bearings[0].sigma_rad = 0.1;
  descriptors.descriptors.resize(2);
  neighbours.neighbours.resize(2);
  trouble.trouble = ImageTrouble::frozen;
  for (const BearingSet& set : {kind, sigma, descriptors, neighbours, trouble}) EXPECT_FALSE(is_plain(set));
}

TEST(Messages, TruthComesBack) {
  const TruthPose truth{stamp_from_us(7), {1.0, 2.0, -3.0}};
  EXPECT_EQ(decode_truth(encoded(to_message(truth, 4))), truth);
}

TEST(Messages, DocumentComesBack) {
  const std::string text("a = 1\n\0\xFF", 8);
  const auto back = decode_document(encoded(to_message("rig.toml", text, stamp_from_us(1))));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->name, "rig.toml");
  EXPECT_EQ(std::string(back->data.begin(), back->data.end()), text);
  EXPECT_TRUE(decode_document(encoded(to_message("", "", stamp_from_us(1)))));
}

TEST(Messages, TrueMapComesBackInChunks) {
  std::vector<TrueLandmark> landmarks;
  landmarks.reserve(1700);
  for (int i = 0; i < 1700; ++i) landmarks.push_back({i, 0.1 * i, -0.1 * i, i % 2 == 0 ? 2.5 : test::kNaN, ""});
  const auto chunks = to_messages(landmarks, stamp_from_us(0));
  ASSERT_EQ(chunks.size(), 3U);
  std::vector<TrueLandmark> back;
  for (const auto& chunk : chunks) {
    const auto decoded = decode_map_chunk(encoded(chunk));
    ASSERT_TRUE(decoded);
    EXPECT_EQ(decoded->chunks, 3);
    for (const auto& landmark : true_landmarks(*decoded)) back.push_back(landmark);
  }
  EXPECT_TRUE(test::same_bits(back, landmarks));
  EXPECT_EQ(to_messages({}, stamp_from_us(0)).size(), 1U) << "an empty map is one empty piece";
}

TEST(Messages, PathComesBack) {
  const auto back = decode_path(encoded(a_path()));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->chunk, 1);
  ASSERT_EQ(back->poses.size(), 2U);
  EXPECT_EQ(back->poses[1].x_m, 1.5);
}

TEST(Messages, SightingsComeBack) {
  const auto back = decode_sightings(encoded(some_sightings()));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->step, 5);
  EXPECT_EQ(back->rejected, 3);
  ASSERT_EQ(back->sightings.size(), 2U);
  EXPECT_EQ(back->sightings[1].landmark_id, 7);
  EXPECT_EQ(back->sightings[1].azimuth_rad, -0.5);
}

TEST(Messages, ExpectationsComeBack) {
  const auto back = decode_expectations(encoded(some_expectations()));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->step, 5);
  EXPECT_EQ(back->nis, 2.5);
  ASSERT_EQ(back->expected.size(), 2U);
  EXPECT_EQ(back->expected[1].landmark_id, 7);
  EXPECT_EQ(back->expected[1].rejected_in_row, 3);
}

TEST(Messages, WhatIsKeptComesBack) {
  const auto back = decode_kept(encoded(some_kept()));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->log_size, 1'000'000);
  EXPECT_EQ(back->map_utime, 1'700'000'000'000'000);
  kept_t message = some_kept();
  message.log_size = -2;
  EXPECT_FALSE(decode_kept(encoded(message)));
  message = some_kept();
  message.log_quota = -1;
  EXPECT_FALSE(decode_kept(encoded(message)));
}

TEST(Messages, StatusComesBack) {
  const auto back = decode_status(encoded(a_status()));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->reason, "few!");
  EXPECT_EQ(back->configuration, "few!!!!!!!!!!");
  EXPECT_EQ(back->landmarks, 9);
  EXPECT_EQ(back->robot_flags, 77);
  EXPECT_TRUE(decode_status(encoded(status_t{}))) << "all texts are empty";
}

TEST(Messages, HeadingsAndAzimuthsAreWrapped) {
  odometry_t odometry = to_message(kReading);
  odometry.heading_rad = 7.0;
  EXPECT_NEAR(decode_odometry(encoded(odometry))->T_odom_body.heading_rad, 7.0 - 2.0 * kPi, 1e-15);
  bearings_t bearings = to_message(kSet);
  bearings.bearings[0].azimuth_rad = kPi;
  EXPECT_EQ(decode_bearings(encoded(bearings))->bearings[0].azimuth_rad, -kPi);
}

}  // namespace
}  // namespace azimuth
