// Millions of valid, damaged and random packets.

#include <gmock/gmock.h>
#include <random>

#include "base/sanitizers.hpp"
#include "tests/drivers/pioneer/conversation.hpp"

namespace azimuth::pioneer {
namespace {

using test::ByteVector;
using Random = std::mt19937_64;

std::uint8_t any_byte(Random& random) { return static_cast<std::uint8_t>(random()); }

/// A valid packet of 2 to 65 bytes.
Frame any_frame(Random& random) {
  std::array<std::uint8_t, 64> data{};
  for (auto& byte : data) byte = any_byte(random);
  return encode_frame(ByteView(data).first(2 + random() % 63));
}

/// Damages a packet: flipped bits, truncation, lost or inserted bytes, or noise only.
void damage(ByteVector& bytes, Random& random) {
  const auto at = static_cast<std::ptrdiff_t>(random() % bytes.size());
  switch (random() % 5) {
    case 0:
      bytes[static_cast<std::size_t>(at)] ^= static_cast<std::uint8_t>(1U << random() % 8);
      break;
    case 1:
      bytes.resize(static_cast<std::size_t>(at));
      break;
    case 2:
      bytes.erase(bytes.begin() + at);
      break;
    case 3:
      bytes.insert(bytes.begin() + at, any_byte(random));
      break;
    default:
      std::ranges::generate(bytes, [&random] { return any_byte(random); });
  }
}

#ifdef AZIMUTH_ADDRESS_SANITIZER
constexpr int kSlower = 20;  // with this sanitizer
#else
constexpr int kSlower = 1;
#endif

// Five million damaged packets, each followed by a valid one. A valid packet may be hidden only if a wrong packet that
// extends into it has a valid checksum by chance: once in 65536, or once in 256 if only the last byte of the wrong
// packet is missing and the header of the valid one takes its place.
TEST(PioneerRobustness, OfTenMillionPacketsTheGoodOnesAreFound) {
  constexpr int kPairs = 5'000'000 / kSlower;
  Random random(1);
  PacketScanner scanner;
  ByteVector bytes;
  std::uint64_t sent = 0, in_packets = 0;
  int hidden = 0;
  for (int i = 0; i < kPairs; ++i) {
    bytes = test::to_vector(any_frame(random).view());
    damage(bytes, random);
    const Frame good = any_frame(random);
    test::append(bytes, good.view());
    sent += bytes.size();
    bool found = false;
    ASSERT_EQ(scanner.add(bytes, {}), bytes.size());
    while (const auto packet = scanner.next()) {
      in_packets += packet->data.size() + kFrameOverhead;
      found = found || std::ranges::equal(packet->data, good.view().subspan(3, good.size - kFrameOverhead));
    }
    if (!found) ++hidden;
  }
  scanner.clear();
  EXPECT_LT(hidden, kPairs / 10'000);
  EXPECT_EQ(in_packets + scanner.skipped_bytes(), sent);
}

/// A script of mostly packets with meaningful ids.
ByteVector any_script(Random& random) {
  constexpr std::array<std::uint8_t, 12> kIds{0, 1, 2, 0x20, 0x32, 0x33, 0x90, 0x98, 0xF0, 0xFE, 0xFF, 0xFA};
  ByteVector script;
  for (int i = 0; i < 60; ++i) {
    const std::size_t length = random() % 32;
    script.push_back(static_cast<std::uint8_t>(8 * length + random() % 8));
    if (script.back() % 8 > 1) continue;
    for (std::size_t j = 0; j < length; ++j) script.push_back(any_byte(random));
    if (length > 0 && random() % 4 != 0) script[script.size() - length] = kIds[random() % kIds.size()];
  }
  return script;
}

TEST(PioneerRobustness, WhateverTheRobotSaysTheSessionRecovers) {
  constexpr int kScripts = 100'000 / kSlower;
  Random random(2);
  int opened = 0;
  std::uint64_t readings = 0;
  for (int i = 0; i < kScripts; ++i) {
    test::Conversation conversation({});
    conversation.play(any_script(random));
    if (conversation.opened() > 0) ++opened;
    readings += conversation.readings();
    ASSERT_TRUE(conversation.recovers()) << i;
  }
  EXPECT_GT(opened, kScripts / 2) << "else the scripts do not reach far";
  EXPECT_GT(readings, 2U * kScripts);
}

}  // namespace
}  // namespace azimuth::pioneer
