#include <algorithm>
#include <gtest/gtest.h>
#include <set>

#include "drivers/wire/messages.hpp"
#include "tests/guest/flood/random_can_frame.hpp"
#include "tests/guest/flood/random_datagram.hpp"

namespace azimuth::guest::test {
namespace {

struct CanTally {
  int extended = 0, remote = 0, fd = 0;
  std::set<int> classic_lengths, fd_lengths;
};

CanTally tally(const CanFloodKinds& kinds) {
  std::mt19937_64 random(3);
  CanTally counts;
  for (int i = 0; i < 5000; ++i) {
    const FloodFrame made = random_can_frame(kinds, random);
    const bool extended = (made.frame.can_id & CAN_EFF_FLAG) != 0, fd = made.bytes == CANFD_MTU;
    const std::uint32_t number = made.frame.can_id & (extended ? CAN_EFF_MASK : CAN_SFF_MASK);
    EXPECT_GE(number, kinds.first_id);
    EXPECT_LE(number, kinds.last_id);
    EXPECT_EQ(std::ranges::count(kinds.spared, number), 0);
    EXPECT_EQ(made.frame.can_id & CAN_ERR_FLAG, 0U);
    counts.extended += extended ? 1 : 0;
    counts.remote += (made.frame.can_id & CAN_RTR_FLAG) != 0 ? 1 : 0;
    counts.fd += fd ? 1 : 0;
    (fd ? counts.fd_lengths : counts.classic_lengths).insert(made.frame.len);
    EXPECT_TRUE(fd || made.bytes == CAN_MTU);
  }
  return counts;
}

TEST(RandomCanFrame, MakesEveryKind) {
  const CanTally classic = tally({});
  EXPECT_GT(classic.extended, 1000);
  EXPECT_GT(5000 - classic.extended, 1000);
  EXPECT_GT(classic.remote, 100);
  EXPECT_EQ(classic.fd, 0);
  EXPECT_EQ(classic.classic_lengths.size(), 9U);
  const CanTally fd = tally({.spared = {}, .fd = true});
  EXPECT_GT(fd.fd, 1000);
  EXPECT_EQ(fd.fd_lengths.size(), 16U);
  EXPECT_EQ(*fd.fd_lengths.rbegin(), 64);
}

TEST(RandomCanFrame, KeepsToItsIdentifiers) {
  tally({.first_id = 0x100, .last_id = 0x10f, .spared = {0x100, 0x10a}});
  const CanTally large = tally({.first_id = 0x1000, .last_id = 0x2000, .spared = {}});
  EXPECT_EQ(large.extended, 5000);
}

TEST(RandomCanFrame, KnowsWhenNothingIsLeft) {
  EXPECT_TRUE(leaves_identifiers({}));
  EXPECT_FALSE(leaves_identifiers({.first_id = 5, .last_id = 4, .spared = {}}));
  EXPECT_FALSE(leaves_identifiers({.first_id = 5, .last_id = 6, .spared = {5, 6}}));
  EXPECT_FALSE(leaves_identifiers({.first_id = 0, .last_id = CAN_EFF_MASK + 1, .spared = {}}));
  // The range has one spared identifier of 11 bits, and one free identifier of 29 bits.
  EXPECT_FALSE(leaves_identifiers({.first_id = 0x7ff, .last_id = 0x800, .spared = {0x7ff}}));
}

TEST(RandomMessages, AreMostlyRefusedAndOftenNearlySound) {
  RandomMessages messages(1);
  int fingerprints = 0;
  std::uint64_t accepted = 0;
  constexpr int kMessages = 20'000;
  Octets odometry_fingerprint(8);
  {
    const odometry_t sound{};
    Octets whole(static_cast<std::size_t>(sound.getEncodedSize()));
    sound.encode(whole.data(), 0, static_cast<int>(whole.size()));
    std::copy_n(whole.begin(), 8, odometry_fingerprint.begin());
  }
  for (int i = 0; i < kMessages; ++i) {
    const Octets& message = messages.next();
    const auto bytes = std::as_bytes(std::span(message));
    fingerprints +=
        message.size() >= 8 && std::equal(odometry_fingerprint.begin(), odometry_fingerprint.end(), message.begin())
            ? 1
            : 0;
    accepted += decode_odometry(bytes) ? 1 : 0;
    accepted += decode_bearings(bytes) ? 1 : 0;
    accepted += decode_features(bytes) ? 1 : 0;
  }
  EXPECT_GT(fingerprints, kMessages / 20);
  EXPECT_LT(accepted, kMessages / 2);
}

TEST(RandomDatagram, ComesInEveryKindAndFitsOnePacket) {
  std::mt19937_64 random(1);
  Octets datagram;
  int whole = 0, pieces = 0, other = 0;
  for (int i = 0; i < 10'000; ++i) {
    random_datagram("CAMERA", random, datagram);
    ASSERT_LE(datagram.size(), kMostDatagramBytes);
    const std::string magic(datagram.begin(),
                            datagram.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(4, datagram.size())));
    ++(magic == "LC02" ? whole : magic == "LC03" ? pieces : other);
  }
  EXPECT_GT(whole, 1000);
  EXPECT_GT(pieces, 1000);
  EXPECT_GT(other, 1000);
}

}  // namespace
}  // namespace azimuth::guest::test
