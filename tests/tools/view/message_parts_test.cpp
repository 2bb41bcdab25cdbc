#include <algorithm>
#include <gmock/gmock.h>
#include <vector>

#include "tools/view/lcm_intake.hpp"

namespace azimuth::test {
namespace {

const std::vector<std::byte> kBytes(3000, std::byte{7});

LcmPacket part(std::uint32_t message, std::uint16_t number, std::uint16_t parts = 3, std::uint32_t size = 3000) {
  return {.sequence = message,
          .channel = number == 0 ? "PICTURE" : std::string_view(),
          .payload = Bytes(kBytes).subspan(1000U * number, 1000),
          .size = size,
          .offset = 1000U * number,
          .part = number,
          .parts = parts};
}

TEST(MessageParts, AreAMessageWhenAllAreThere) {
  MessageParts parts;
  EXPECT_FALSE(parts.take(part(1, 0), 1));
  EXPECT_FALSE(parts.take(part(1, 2), 1));
  EXPECT_FALSE(parts.take(part(1, 2), 1)) << "twice";
  const auto whole = parts.take(part(1, 1), 1);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->channel, "PICTURE");
  EXPECT_TRUE(std::ranges::equal(whole->data, kBytes));
}

TEST(MessageParts, OfTwoSendersAreKeptApart) {
  MessageParts parts;
  parts.take(part(1, 0), 1);
  parts.take(part(1, 0), 2);
  parts.take(part(1, 1), 1);
  EXPECT_FALSE(parts.take(part(1, 2), 2));
  EXPECT_TRUE(parts.take(part(1, 2), 1));
}

TEST(MessageParts, ContradictionsAndGiantsAreLeftOut) {
  MessageParts parts;
  EXPECT_FALSE(parts.take(part(1, 1), 1)) << "the beginning is missing";
  EXPECT_FALSE(parts.take(part(2, 0, 3, 0x7fffffff), 1)) << "larger than anything that is shown";
  parts.take(part(3, 0), 1);
  parts.take(part(3, 1, 3, 2999), 1);
  EXPECT_FALSE(parts.take(part(3, 2), 1)) << "one part said another size";
  EXPECT_FALSE(parts.take(part(4, 0, 60000), 1));
}

TEST(MessageParts, ManySendersDoNotGrowIt) {
  MessageParts parts;
  for (LcmPeer sender = 0; sender < 1000; ++sender) parts.take(part(1, 0), sender);
  parts.take(part(1, 1), 999);
  EXPECT_TRUE(parts.take(part(1, 2), 999)) << "the newest are kept";
  parts.take(part(1, 1), 0);
  EXPECT_FALSE(parts.take(part(1, 2), 0)) << "the oldest gave way";
}

}  // namespace
}  // namespace azimuth::test
