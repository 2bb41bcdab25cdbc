// The wire format must stay stable: a changed fingerprint makes the messages unreadable for all subscribers and all old
// logs. A message that must change gets a new type (`_v2`) instead.

#include <azimuth/bearing_t.hpp>
#include <azimuth/bearings_t.hpp>
#include <azimuth/document_t.hpp>
#include <azimuth/expectations_t.hpp>
#include <azimuth/expected_bearing_t.hpp>
#include <azimuth/features_t.hpp>
#include <azimuth/image_t.hpp>
#include <azimuth/kept_t.hpp>
#include <azimuth/landmark_t.hpp>
#include <azimuth/map_chunk_t.hpp>
#include <azimuth/odometry_t.hpp>
#include <azimuth/path_t.hpp>
#include <azimuth/pose_cov_t.hpp>
#include <azimuth/pose_t.hpp>
#include <azimuth/sightings_t.hpp>
#include <azimuth/status_t.hpp>
#include <gtest/gtest.h>

namespace azimuth {
namespace {

template <class Message>
std::uint64_t fingerprint() {
  return static_cast<std::uint64_t>(Message::getHash());
}

/// Largest message that fits into one datagram everywhere.
constexpr int kDatagram = 60'000;

TEST(LcmTypes, FingerprintsAreThoseOfTheFirstRelease) {
  EXPECT_EQ(fingerprint<bearing_t>(), 0x93d0ba096f5921a3U);
  EXPECT_EQ(fingerprint<bearings_t>(), 0x76f1b8ecde020cc4U);
  EXPECT_EQ(fingerprint<descriptor_t>(), 0x6e7d973985cca808U);
  EXPECT_EQ(fingerprint<document_t>(), 0x6ffd5cddffbd3198U);
  EXPECT_EQ(fingerprint<expectations_t>(), 0xa03cbb703bdb4c9aU);
  EXPECT_EQ(fingerprint<expected_bearing_t>(), 0xb8c3d17fc2a62a08U);
  EXPECT_EQ(fingerprint<feature_t>(), 0xf85452514766a577U);
  EXPECT_EQ(fingerprint<features_t>(), 0x34d6d7284aee61d7U);
  EXPECT_EQ(fingerprint<kept_t>(), 0xdc5efea71fac599dU);
  EXPECT_EQ(fingerprint<landmark_t>(), 0x021fa17cc2772f32U);
  EXPECT_EQ(fingerprint<map_chunk_t>(), 0x1b073c1c36be5a2cU);
  EXPECT_EQ(fingerprint<neighbours_t>(), 0x1bff1a9ace9be786U);
  EXPECT_EQ(fingerprint<odometry_t>(), 0x7790dcf7edd5b500U);
  EXPECT_EQ(fingerprint<path_pose_t>(), 0xf992dcb07a737b84U);
  EXPECT_EQ(fingerprint<path_t>(), 0xb816b3e3cacdd7eaU);
  EXPECT_EQ(fingerprint<pose_cov_t>(), 0x5e9e0135cb914c74U);
  EXPECT_EQ(fingerprint<sighting_t>(), 0x8b7dc1622ae1edaeU);
  EXPECT_EQ(fingerprint<sightings_t>(), 0x08ea2e81d5d09e01U);
  EXPECT_EQ(fingerprint<status_t>(), 0x38b28c139ab16a28U);
}

TEST(LcmTypes, ImagesAreThoseOfBotCore) { EXPECT_EQ(fingerprint<image_t>(), 0x14739ffe13d5f5f0U); }

TEST(LcmTypes, PoseIsUnderstoodByProgramsThatKnowBotCore) { EXPECT_EQ(fingerprint<pose_t>(), 0x2e16efb052b0105eU); }

TEST(LcmTypes, FullestMapChunkFitsADatagram) {
  map_chunk_t chunk{};
  chunk.n = map_chunk_t::MAX_LANDMARKS;
  chunk.landmarks.resize(static_cast<std::size_t>(chunk.n));
  EXPECT_LE(chunk.getEncodedSize(), kDatagram);
}

TEST(LcmTypes, FullestPathChunkFitsADatagram) {
  path_t path{};
  path.n = path_t::MAX_POSES;
  path.poses.resize(static_cast<std::size_t>(path.n));
  EXPECT_LE(path.getEncodedSize(), kDatagram);
}

TEST(LcmTypes, FullestSightingsFitADatagram) {
  sightings_t sightings{};
  sightings.n = sightings_t::MAX_SIGHTINGS;
  sightings.sightings.resize(static_cast<std::size_t>(sightings.n));
  EXPECT_LE(sightings.getEncodedSize(), kDatagram);
}

TEST(LcmTypes, FullestExpectationsFitADatagram) {
  expectations_t expectations{};
  expectations.n = expectations_t::MAX_EXPECTED;
  expectations.expected.resize(static_cast<std::size_t>(expectations.n));
  EXPECT_LE(expectations.getEncodedSize(), kDatagram);
}

TEST(LcmTypes, FullestBearingSetFitsADatagram) {
  bearings_t bearings{};
  bearings.n = bearings_t::MAX_BEARINGS;
  bearings.bearings.resize(static_cast<std::size_t>(bearings.n));
  EXPECT_LE(bearings.getEncodedSize(), kDatagram);
}

}  // namespace
}  // namespace azimuth
