#include "drivers/storage/map_codec.hpp"

#include <bit>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <zlib.h>

#include "tests/support/random_map.hpp"

namespace azimuth {
namespace {

std::vector<std::byte> encoded(const MapSnapshot& map) {
  std::vector<std::byte> bytes;
  encode(map, bytes);
  return bytes;
}

std::optional<std::string> problem_of(Bytes bytes) {
  MapSnapshot ignored;
  return decode_map(bytes, ignored);
}

void expect_equal(const MapSnapshot& a, const MapSnapshot& b) {
  EXPECT_EQ(a.stamp, b.stamp);
  EXPECT_EQ(a.T_map_body, b.T_map_body);
  EXPECT_EQ(a.camera, b.camera);
  EXPECT_EQ(a.covariance, b.covariance);
  EXPECT_EQ(a.views, b.views);
  EXPECT_EQ(a.names, b.names);
  EXPECT_EQ(a.next_id, b.next_id);
  EXPECT_EQ(a.next_identity, b.next_identity);
  ASSERT_EQ(a.landmarks.size(), b.landmarks.size());
  for (std::size_t i = 0; i < a.landmarks.size(); ++i) {
    const MapLandmark &one = a.landmarks[i], &other = b.landmarks[i];
    EXPECT_EQ(one.id, other.id);
    EXPECT_EQ(one.identity, other.identity);
    EXPECT_EQ(one.kind, other.kind);
    EXPECT_EQ(one.sightings, other.sightings);
    EXPECT_EQ(one.p_map_landmark_m, other.p_map_landmark_m);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(one.z_map_landmark_m), std::bit_cast<std::uint64_t>(other.z_map_landmark_m));
  }
}

RC_GTEST_PROP(MapCodec, GivesBackEveryBit, (unsigned seed)) {
  const RandomMapSettings settings{*rc::gen::inRange<std::size_t>(0, 12), *rc::gen::inRange<std::size_t>(0, 4),
                                   *rc::gen::inRange<std::size_t>(0, 3), *rc::gen::arbitrary<bool>()};
  const MapSnapshot map = random_map(seed, settings);
  const std::vector<std::byte> bytes = encoded(map);
  RC_ASSERT(bytes.size() == encoded_size(map));
  MapSnapshot again = random_map(seed + 1);  // earlier content, which must be replaced
  const std::optional<std::string> problem = decode_map(bytes, again);
  RC_ASSERT(!problem);
  expect_equal(again, map);
  RC_ASSERT(encoded(again) == bytes);
}

TEST(MapCodec, NoticesDamageToAnyByte) {
  for (const bool heights : {false, true}) {
    const std::vector<std::byte> good = encoded(random_map(1, {5, 3, 2, heights}));
    ASSERT_FALSE(problem_of(good));
    for (std::size_t at = 0; at < good.size(); ++at)
      for (const unsigned flipped : {0x01U, 0x80U, 0xffU}) {
        std::vector<std::byte> bad = good;
        bad[at] ^= static_cast<std::byte>(flipped);
        ASSERT_TRUE(problem_of(bad)) << "byte " << at << " of " << good.size();
      }
  }
}

TEST(MapCodec, NoticesThatAnyPartIsMissingOrTooMuch) {
  std::vector<std::byte> bytes = encoded(random_map(2, {5, 0, 2}));
  for (std::size_t size = 0; size < bytes.size(); ++size) ASSERT_TRUE(problem_of(Bytes(bytes).first(size))) << size;
  bytes.push_back(std::byte{0});
  EXPECT_EQ(problem_of(bytes), "is longer than it says");
}

TEST(MapCodec, SaysWhatIsWrong) {
  std::vector<std::byte> bytes = encoded(random_map(3));
  EXPECT_EQ(problem_of(Bytes(bytes).first(100)), "is cut short");
  EXPECT_EQ(problem_of(Bytes(bytes).subspan(1)), "is no map");
  bytes[200] ^= std::byte{1};
  EXPECT_EQ(problem_of(bytes), "is damaged: its checksum is wrong");
}

/// One error in an otherwise valid map, which the checksum does not detect.
struct Nonsense {
  const char* what;
  std::function<void(MapSnapshot&)> make;
};
std::ostream& operator<<(std::ostream& out, const Nonsense& nonsense) { return out << nonsense.what; }

class MapNonsense : public testing::TestWithParam<Nonsense> {};

TEST_P(MapNonsense, IsRefused) {
  MapSnapshot map = random_map(4, {6, 2, 1});
  ASSERT_FALSE(implausible(map));
  GetParam().make(map);
  EXPECT_TRUE(implausible(map));
  EXPECT_EQ(problem_of(encoded(map)), implausible(map));
}

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    Of, MapNonsense,
    testing::Values(Nonsense{"Pose", [](MapSnapshot& map) { map.T_map_body.x_m = kNaN; }},
                    Nonsense{"Stamp", [](MapSnapshot& map) { map.stamp = Stamp::max(); }},
                    Nonsense{"Camera", [](MapSnapshot& map) { map.camera[1] = INFINITY; }},
                    Nonsense{"Position", [](MapSnapshot& map) { map.landmarks[2].p_map_landmark_m.y() = 1e9; }},
                    Nonsense{"Kind", [](MapSnapshot& map) { map.landmarks[2].kind = -2; }},
                    Nonsense{"Id", [](MapSnapshot& map) { map.landmarks[2].id = map.landmarks[3].id; }},
                    Nonsense{"NegativeId", [](MapSnapshot& map) { map.landmarks[0].id = -1; }},
                    Nonsense{"IdToCome", [](MapSnapshot& map) { map.next_id = map.landmarks.back().id; }},
                    Nonsense{"NameToCome", [](MapSnapshot& map) { map.next_identity = 1; }},
                    Nonsense{"Looks", [](MapSnapshot& map) { map.views[0].identity = 1000; }},
                    Nonsense{"LooksWithoutUse", [](MapSnapshot& map) { map.names = MapNames::sensor; }},
                    Nonsense{"PlaceOfLooks", [](MapSnapshot& map) { map.views[0].p_map_robot_m.x() = kNaN; }},
                    Nonsense{"Variance", [](MapSnapshot& map) { map.covariance(4, 4) = -1e-9; }},
                    Nonsense{"Certainty", [](MapSnapshot& map) { map.covariance(4, 4) = 0.0; }},
                    Nonsense{"Covariance", [](MapSnapshot& map) { map.covariance(7, 4) = kNaN; }},
                    Nonsense{"Correlation", [](MapSnapshot& map) { map.covariance(7, 4) = 1.0; }},
                    Nonsense{"Definiteness",
                             [](MapSnapshot& map) {
                               for (const std::size_t i : {5, 6, 7}) map.covariance(i, i) = 1.0;
                               map.covariance(6, 5) = map.covariance(7, 5) = 0.9;
                               map.covariance(7, 6) = -0.9;
                             }}),
    [](const auto& nonsense) { return std::string(nonsense.param.what); });

TEST(MapCodec, TakesARobotThatIsCertainOfItsPose) {
  MapSnapshot map = random_map(5);
  for (std::size_t row = 0; row < map.entries(); ++row)
    for (std::size_t i = 0; i < 3; ++i) map.covariance(row, i) = 0.0;
  EXPECT_FALSE(problem_of(encoded(map)));
}

/// Renews the checksum.
std::vector<std::byte> sealed(std::vector<std::byte> bytes) {
  const std::size_t size = bytes.size() - 4;
  const auto sum = static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), size));
  for (std::size_t i = 0; i < 4; ++i) bytes[size + i] = static_cast<std::byte>(sum >> (8 * i) & 0xffU);
  return bytes;
}

TEST(MapCodec, RefusesAVersionToComeAndSaysSo) {
  std::vector<std::byte> bytes = encoded(random_map(6));
  bytes[kMapMagic.size()] = std::byte{2};
  EXPECT_EQ(problem_of(sealed(bytes)), "is of version 2, and this program reads version 1");
}

TEST(MapCodec, BelievesNoCountBeyondTheFile) {
  const std::vector<std::byte> good = encoded(random_map(7, {5, 2, 1}));
  for (std::size_t at = kMapMagic.size() + 12; at < kMapMagic.size() + 28; ++at) {  // the four counts
    for (const unsigned value : {0x00U, 0x07U, 0x7fU, 0xffU}) {
      std::vector<std::byte> bad = good;
      bad[at] = static_cast<std::byte>(value);
      if (bad != good) {
        EXPECT_TRUE(problem_of(sealed(bad))) << at;
      }
    }
  }
}

}  // namespace
}  // namespace azimuth
