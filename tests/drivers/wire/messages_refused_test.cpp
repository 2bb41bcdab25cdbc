// Impossible values and invalid messages must be refused.

#include <azimuth/pose_t.hpp>
#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <limits>
#include <random>

#include "drivers/wire/messages.hpp"
#include "tests/drivers/wire/sample_messages.hpp"

namespace azimuth {
namespace {

using namespace test;

TEST(Messages, SightingsThatCannotBeTrueAreRefused) {
  sightings_t message = some_sightings();
  message.sightings[0].azimuth_rad = test::kNaN;
  EXPECT_FALSE(decode_sightings(encoded(message)));
  message = some_sightings();
  message.sightings[0].elevation_rad = kInfinity;
  EXPECT_FALSE(decode_sightings(encoded(message)));
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

TEST(Messages, AnotherTypeIsRefused) {
  EXPECT_FALSE(decode_odometry(encoded(to_message(kSet))));
  EXPECT_FALSE(decode_bearings(encoded(to_message(kReading))));
  EXPECT_FALSE(decode_odometry(encoded(pose_t{})));
  Buffer data = encoded(to_message(kReading));
  data[3] ^= std::byte{1};
  EXPECT_FALSE(decode_odometry(data));
}

/// Whether any decoder accepts the bytes. Many tests only check that the decoders return at all.
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
      if (message == 4 && lie == 3) continue;  // this value is correct
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

/// Decoders accept them, so that the estimator's stage can report them.
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

TEST(Messages, TextsThatEndTooEarlyOrNotAtAllAreRefused) {
  const Buffer document = one_of_each()[3];
  const std::size_t name = 36, end = name + std::string_view("rig.toml").size();
  ASSERT_TRUE(decode_document(document));
  for (const auto& [at, byte] : {std::pair{name + 3, 0}, {end, 'x'}}) {
    Buffer damaged = document;
    damaged[at] = static_cast<std::byte>(byte);
    EXPECT_FALSE(decode_document(damaged)) << at;
  }
}

/// Whether the decoder accepts the bytes. Its result must survive encoding and decoding, although angles are wrapped
/// and samples omit unused parts.
template <class Decoder, class ToMessage = std::identity>
bool is_read_for_good(Decoder decode, const Buffer& data, ToMessage to_message_of = {}) {
  const auto read = decode(data);
  if (!read) return false;
  const Buffer written = encoded(to_message_of(*read));
  const auto again = decode(written);
  EXPECT_TRUE(again && encoded(to_message_of(*again)) == written);
  return true;
}

int decoders_that_take(const Buffer& data) {
  const auto of = [](const auto& sample) { return to_message(sample); };
  return is_read_for_good(decode_odometry, data, of) + is_read_for_good(decode_bearings, data, of) +
         is_read_for_good(decode_features, data, to_features_message) + is_read_for_good(decode_map_chunk, data) +
         is_read_for_good(decode_document, data) + is_read_for_good(decode_path, data) +
         is_read_for_good(decode_status, data) + is_read_for_good(decode_sightings, data) +
         is_read_for_good(decode_expectations, data) + is_read_for_good(decode_kept, data);
}

TEST(Messages, ChangedBytesAreRefusedOrReadForGood) {
  const auto data = one_of_each();
  std::mt19937_64 bits(3);
  int taken = 0;
  constexpr int kRounds = 50'000;
  for (int round = 0; round < kRounds; ++round) {
    Buffer damaged = data[bits() % data.size()];
    for (auto changes = 1 + bits() % 6; changes-- > 0;)
      damaged[8 + bits() % (damaged.size() - 8)] = static_cast<std::byte>(bits());
    const int decoders = decoders_that_take(damaged);
    ASSERT_LE(decoders, 1) << "its type is told by what stands before";
    taken += decoders;
  }
  EXPECT_GT(taken, kRounds / 10);
  EXPECT_LT(taken, kRounds * 9 / 10);
}

}  // namespace
}  // namespace azimuth
