#include "drivers/wire/messages.hpp"

#include <azimuth/pose_t.hpp>
#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <limits>
#include <random>

#include "tests/drivers/wire/samples.hpp"

namespace azimuth {
namespace {

using Buffer = std::vector<std::byte>;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Message>
Buffer encoded(const Message& message) {
  Buffer out;
  encode(message, out);
  return out;
}

/// Overwrites a big-endian int32.
void put_int32(Buffer& data, std::size_t at, std::int64_t value) {
  for (std::size_t i = 0; i < 4; ++i) data[at + i] = static_cast<std::byte>((value >> (24 - 8 * i)) & 0xFF);
}

const BearingSet kSet{stamp_from_us(1'700'000'000'123'456), 9, {{0.5, test::kNaN, -1}, {-3.0, 0.25, 12}}};
const OdometryReading kReading{stamp_from_us(-5), 3, 0xFFFFFFFFU, {1.0, -2.0, 3.0}, 0.25, 0.125};

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
  fill_message(test::feature_set(20), message);  // storage is used again
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

path_t a_path() {
  path_t path{};
  path.seq = 3;
  path.chunk = 1;
  path.chunks = 2;
  path.n = 2;
  path.poses.resize(2);
  path.poses[1].x_m = 1.5;
  return path;
}

/// Every text has a length of its own.
status_t a_status() {
  status_t status{};
  std::string letters = "few";
  for (std::string* text :
       {&status.reason, &status.image_trouble, &status.input_trouble, &status.map_trouble, &status.picture_trouble,
        &status.odometer, &status.camera, &status.recorder, &status.realtime, &status.configuration})
    *text = letters += '!';
  status.robot_flags = 77;
  status.battery_v = 12.5;
  status.landmarks = 9;
  return status;
}

TEST(Messages, PathComesBack) {
  const auto back = decode_path(encoded(a_path()));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->chunk, 1);
  ASSERT_EQ(back->poses.size(), 2U);
  EXPECT_EQ(back->poses[1].x_m, 1.5);
}

sightings_t some_sightings() {
  sightings_t message{};
  message.step = 5;
  message.rejected = 3;
  message.n = 2;
  message.sightings.resize(2);
  message.sightings[1].landmark_id = 7;
  message.sightings[1].azimuth_rad = -0.5;
  message.sightings[1].elevation_rad = test::kNaN;
  return message;
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

TEST(Messages, SightingsThatCannotBeTrueAreRefused) {
  sightings_t message = some_sightings();
  message.sightings[0].azimuth_rad = test::kNaN;
  EXPECT_FALSE(decode_sightings(encoded(message)));
  message = some_sightings();
  message.sightings[0].elevation_rad = kInfinity;
  EXPECT_FALSE(decode_sightings(encoded(message)));
}

expectations_t some_expectations() {
  expectations_t message{};
  message.step = 5;
  message.nis = 2.5;
  message.compared = 2;
  message.n = 2;
  message.expected.resize(2);
  message.expected[0].elevation_rad = test::kNaN;
  message.expected[1].landmark_id = 7;
  message.expected[1].azimuth_rad = -0.5;
  message.expected[1].rejected_in_row = 3;
  return message;
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

TEST(Messages, ExpectationsThatCannotBeTrueAreRefused) {
  for (const double nis : {-1.0, test::kNaN, kInfinity}) {
    expectations_t message = some_expectations();
    message.nis = nis;
    EXPECT_FALSE(decode_expectations(encoded(message))) << nis;
  }
  expectations_t message = some_expectations();
  message.expected[0].azimuth_rad = kInfinity;
  EXPECT_FALSE(decode_expectations(encoded(message)));
  message = some_expectations();
  message.compared = -1;
  EXPECT_FALSE(decode_expectations(encoded(message)));
}

kept_t some_kept() {
  kept_t message{};
  message.log_size = 1'000'000;
  message.disk_free = -1;
  message.map_utime = 1'700'000'000'000'000;
  return message;
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

TEST(Messages, AnotherTypeIsRefused) {
  EXPECT_FALSE(decode_odometry(encoded(to_message(kSet))));
  EXPECT_FALSE(decode_bearings(encoded(to_message(kReading))));
  EXPECT_FALSE(decode_odometry(encoded(pose_t{})));
  Buffer data = encoded(to_message(kReading));
  data[3] ^= std::byte{1};
  EXPECT_FALSE(decode_odometry(data));
}

/// Whether any decoder takes the bytes; that it returns at all is the point of many tests.
bool any_decodes(Bytes data) {
  return decode_odometry(data) || decode_bearings(data) || decode_features(data) || decode_map_chunk(data) ||
         decode_document(data) || decode_path(data) || decode_status(data) || decode_sightings(data) ||
         decode_expectations(data) || decode_kept(data);
}

std::vector<Buffer> one_of_each() {
  const std::vector<TrueLandmark> landmarks{{1, 2.0, 3.0, test::kNaN, ""}, {2, 4.0, 5.0, 6.0, ""}};
  return {encoded(to_message(kReading)),
          encoded(to_message(kSet)),
          encoded(to_messages(landmarks, stamp_from_us(0)).front()),
          encoded(to_message("rig.toml", "front_end = 1", stamp_from_us(0))),
          encoded(to_features_message(test::feature_set(3))),
          encoded(a_path()),
          encoded(a_status()),
          encoded(some_sightings()),
          encoded(some_expectations()),
          encoded(some_kept())};
}

TEST(Messages, AnyOtherLengthIsRefused) {
  for (const Buffer& data : one_of_each()) {
    ASSERT_TRUE(any_decodes(data));
    for (std::size_t length = 0; length < data.size(); ++length) EXPECT_FALSE(any_decodes(Bytes(data).first(length)));
    Buffer longer = data;
    longer.push_back(std::byte{0});
    EXPECT_FALSE(any_decodes(longer));
  }
}

TEST(Messages, CountsThatLieAreRefusedBeforeAnythingIsAllocated) {
  const auto data = one_of_each();
  const std::size_t bearings_n = 32, map_n = 40, name_length = 32, document_size = 36 + 9, features_n = 33, path_n = 40,
                    first_text = 33, second_text = 33 + 4 + 5 + 188;
  for (const std::int64_t lie : {-1L, 0L, 1L, 3L, 100'000L, 0x7FFFFFFFL, -0x80000000L}) {
    for (const auto& [message, at] : {std::pair{1, bearings_n},
                                      {2, map_n},
                                      {3, name_length},
                                      {3, document_size},
                                      {4, features_n},
                                      {4, features_n + 4},
                                      {4, features_n + 8},
                                      {5, path_n},
                                      {6, first_text},
                                      {6, second_text}}) {
      if (message == 4 && lie == 3) continue;  // is true
      Buffer damaged = data[static_cast<std::size_t>(message)];
      put_int32(damaged, at, lie);
      EXPECT_FALSE(any_decodes(damaged)) << "message " << message << " count " << lie;
    }
  }
}

TEST(Messages, OdometryThatCannotBeTrueIsRefused) {
  const std::function<void(odometry_t&)> wrongs[] = {
      [](odometry_t& m) { m.x_m = test::kNaN; },
      [](odometry_t& m) { m.y_m = kInfinity; },
      [](odometry_t& m) { m.heading_rad = test::kNaN; },
      [](odometry_t& m) { m.x_m = 1e8; },
      [](odometry_t& m) { m.heading_rad = -kInfinity; },
      [](odometry_t& m) { m.sigma_gap_m = test::kNaN; },
      [](odometry_t& m) { m.sigma_gap_m = -0.1; },
      [](odometry_t& m) { m.sigma_gap_rad = kInfinity; },
      [](odometry_t& m) { m.utime = std::numeric_limits<std::int64_t>::min(); },
      [](odometry_t& m) { m.utime = std::numeric_limits<std::int64_t>::max(); }};
  for (const auto& wrong : wrongs) {
    odometry_t message = to_message(kReading);
    wrong(message);
    EXPECT_FALSE(decode_odometry(encoded(message)));
  }
}

TEST(Messages, BearingsThatCannotBeTrueAreRefused) {
  const std::function<void(bearing_t&)> wrongs[] = {
      [](bearing_t& b) { b.azimuth_rad = test::kNaN; }, [](bearing_t& b) { b.azimuth_rad = kInfinity; },
      [](bearing_t& b) { b.azimuth_rad = 361.0; },      [](bearing_t& b) { b.elevation_rad = kInfinity; },
      [](bearing_t& b) { b.elevation_rad = 361.0; },    [](bearing_t& b) { b.identity = -2; }};
  for (const auto& wrong : wrongs) {
    bearings_t message = to_message(kSet);
    wrong(message.bearings[1]);
    EXPECT_FALSE(decode_bearings(encoded(message)));
  }
}

/// So that the estimator's stage can say that they are.
TEST(Messages, BearingsInDegreesGetThroughAsTheyAre) {
  bearings_t message = to_message(kSet);
  message.bearings[1].azimuth_rad = 170.0;
  const auto set = decode_bearings(encoded(message));
  ASSERT_TRUE(set);
  EXPECT_EQ(set->bearings[1].azimuth_rad, 170.0);
}

TEST(Messages, FeaturesThatCannotBeTrueAreRefused) {
  const std::function<void(features_t&)> wrongs[] = {
      [](features_t& m) { m.features[1].azimuth_rad = test::kNaN; },
      [](features_t& m) { m.features[1].kind = -2; },
      [](features_t& m) { m.features[1].sigma_rad = 0.0; },
      [](features_t& m) { m.features[1].sigma_rad = -0.1; },
      [](features_t& m) { m.features[1].radius_px = -1.0; },
      [](features_t& m) { m.features[1].sigma_elevation_rad = 0.0; },
      [](features_t& m) { m.features[1].sigma_rad = kInfinity; },
      [](features_t& m) { m.features[1].identity = -2; },
      [](features_t& m) { m.neighbours[2].index[4] = 3; },
      [](features_t& m) { m.neighbours[0].index[0] = -2; },
      [](features_t& m) { m.trouble = -1; },
      [](features_t& m) { m.trouble = kImageTroubles; },
      [](features_t& m) { m.utime = std::numeric_limits<std::int64_t>::max(); },
      [](features_t& m) { m.n_descriptors = 2, m.descriptors.resize(2); },
      [](features_t& m) { m.n_neighbours = 1, m.neighbours.resize(1); }};
  for (const auto& wrong : wrongs) {
    features_t message = to_features_message(test::feature_set(3));
    wrong(message);
    EXPECT_FALSE(decode_features(encoded(message)));
  }
}

TEST(Messages, MapsThatCannotBeTrueAreRefused) {
  const std::vector<TrueLandmark> landmarks{{1, 2.0, 3.0, test::kNaN, ""}};
  const std::function<void(map_chunk_t&)> wrongs[] = {
      [](map_chunk_t& m) { m.landmarks[0].x_m = test::kNaN; }, [](map_chunk_t& m) { m.landmarks[0].z_m = kInfinity; },
      [](map_chunk_t& m) { m.landmarks[0].covariance[2] = test::kNaN; }, [](map_chunk_t& m) { m.chunk = 1; },
      [](map_chunk_t& m) { m.chunk = -1; }};
  for (const auto& wrong : wrongs) {
    map_chunk_t message = to_messages(landmarks, stamp_from_us(0)).front();
    wrong(message);
    EXPECT_FALSE(decode_map_chunk(encoded(message)));
  }
}

TEST(Messages, PathsThatCannotBeTrueAreRefused) {
  const std::function<void(path_t&)> wrongs[] = {
      [](path_t& m) { m.poses[0].x_m = test::kNaN; }, [](path_t& m) { m.poses[0].heading_rad = kInfinity; },
      [](path_t& m) { m.poses[1].utime = std::numeric_limits<std::int64_t>::max(); }, [](path_t& m) { m.chunk = 2; },
      [](path_t& m) { m.chunk = -1; }};
  for (const auto& wrong : wrongs) {
    path_t message = a_path();
    wrong(message);
    EXPECT_FALSE(decode_path(encoded(message)));
  }
}

TEST(Messages, ChangedBytesNeverBreakADecoder) {
  const auto data = one_of_each();
  std::mt19937_64 bits(3);
  for (int round = 0; round < 50'000; ++round) {
    Buffer damaged = data[bits() % data.size()];
    for (auto changes = 1 + bits() % 6; changes-- > 0;)
      damaged[8 + bits() % (damaged.size() - 8)] = static_cast<std::byte>(bits());
    any_decodes(damaged);
  }
}

}  // namespace
}  // namespace azimuth
