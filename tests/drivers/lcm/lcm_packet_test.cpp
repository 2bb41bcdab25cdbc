#include "drivers/lcm/lcm_packet.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <string>

#include "tests/drivers/lcm/datagrams.hpp"

namespace azimuth {
namespace {

using test::Datagram;
using test::one_part;
using test::PartHeader;
using test::whole_message;

const Datagram kMessage{std::byte{1}, std::byte{2}, std::byte{3}, std::byte{4}, std::byte{5}};

bool same(Bytes a, Bytes b) { return std::ranges::equal(a, b); }

TEST(LcmPacket, ReadsAWholeMessage) {
  const Datagram datagram = whole_message(7, "CAMERA", kMessage);
  const auto packet = decode_lcm_packet(datagram);
  ASSERT_TRUE(packet);
  EXPECT_EQ(packet->sequence, 7U);
  EXPECT_EQ(packet->channel, "CAMERA");
  EXPECT_EQ(packet->parts, 1);
  EXPECT_EQ(packet->part, 0);
  EXPECT_EQ(packet->size, 5U);
  EXPECT_TRUE(same(packet->payload, kMessage));
}

TEST(LcmPacket, ReadsParts) {
  const auto datagrams = test::in_parts(9, "CAMERA", kMessage, 2);
  ASSERT_EQ(datagrams.size(), 3U);
  for (std::uint16_t part = 0; part < 3; ++part) {
    const auto packet = decode_lcm_packet(datagrams[part]);
    ASSERT_TRUE(packet);
    EXPECT_EQ(packet->sequence, 9U);
    EXPECT_EQ(packet->channel, part == 0 ? "CAMERA" : "");
    EXPECT_EQ(packet->size, 5U);
    EXPECT_EQ(packet->offset, 2U * part);
    EXPECT_EQ(packet->part, part);
    EXPECT_EQ(packet->parts, 3);
    EXPECT_TRUE(same(packet->payload, Bytes(kMessage).subspan(2U * part, part == 2 ? 1 : 2)));
  }
}

TEST(LcmPacket, AMessageMayBeEmpty) {
  const auto packet = decode_lcm_packet(whole_message(0, "A", {}));
  ASSERT_TRUE(packet);
  EXPECT_EQ(packet->size, 0U);
}

TEST(LcmPacket, ChannelsHaveALimitAndAnEnd) {
  EXPECT_TRUE(decode_lcm_packet(whole_message(0, std::string(63, 'x'), kMessage)));
  EXPECT_FALSE(decode_lcm_packet(whole_message(0, std::string(64, 'x'), kMessage)));
  EXPECT_FALSE(decode_lcm_packet(whole_message(0, "", kMessage)));
  Datagram endless = whole_message(0, "CAMERA", {});
  endless.pop_back();
  EXPECT_FALSE(decode_lcm_packet(endless));
  Datagram part = one_part({0, 0, 0, 0, 2}, "CAMERA", {});
  EXPECT_TRUE(decode_lcm_packet(part));
  part.pop_back();
  EXPECT_FALSE(decode_lcm_packet(part));
}

TEST(LcmPacket, PartsLieWithinTheirMessage) {
  const auto fits = [](const PartHeader& header) {
    return decode_lcm_packet(one_part(header, "CAMERA", kMessage)).has_value();
  };
  EXPECT_TRUE(fits({0, 10, 5, 1, 2}));
  EXPECT_FALSE(fits({0, 10, 6, 1, 2})) << "beyond the end";
  EXPECT_FALSE(fits({0, 4, 0, 0, 2}));
  EXPECT_FALSE(fits({0, 10, 0xFFFFFFFEU, 1, 2})) << "a sum that overflows";
  EXPECT_FALSE(fits({0, 0xFFFFFFFFU, 0xFFFFFFFBU, 1, 2}));
  EXPECT_TRUE(fits({0, 0xFFFFFFFFU, 0xFFFFFFFAU, 1, 2}));
  EXPECT_FALSE(fits({0, 10, 5, 2, 2})) << "no such part";
  EXPECT_FALSE(fits({0, 10, 5, 0, 0}));
}

TEST(LcmPacket, RefusesEveryOtherKindAndEveryCutHeader) {
  Datagram datagram = whole_message(0, "A", kMessage);
  for (std::size_t i = 0; i < 4; ++i) {
    Datagram other = datagram;
    other[i] ^= std::byte{0x40};
    EXPECT_FALSE(decode_lcm_packet(other));
  }
  for (std::size_t size = 0; size < 10; ++size) EXPECT_FALSE(decode_lcm_packet(Bytes(datagram).first(size)));
  const Datagram part = one_part({0, 10, 5, 1, 2}, "", kMessage);
  for (std::size_t size = 0; size < 20; ++size) EXPECT_FALSE(decode_lcm_packet(Bytes(part).first(size)));
}

RC_GTEST_PROP(LcmPacket, WhatIsAcceptedLiesWithinTheDatagramAndTheMessage, ()) {
  const auto small = rc::gen::inRange<std::uint32_t>(0, 40);
  const auto header =
      PartHeader{*small, *small, *small, static_cast<std::uint16_t>(*small), static_cast<std::uint16_t>(*small)};
  const auto tail = *rc::gen::container<std::vector<std::uint8_t>>(rc::gen::inRange<std::uint8_t>(0, 4));
  const Datagram datagram = one_part(header, "AB", std::as_bytes(std::span(tail)));
  if (const auto packet = decode_lcm_packet(datagram)) {
    const Bytes payload = packet->payload;
    RC_ASSERT(payload.data() >= datagram.data() &&
              payload.data() + payload.size() == datagram.data() + datagram.size());
    RC_ASSERT(std::uint64_t{packet->offset} + payload.size() <= packet->size);
    RC_ASSERT(packet->part < packet->parts);
  }
}

}  // namespace
}  // namespace azimuth
