// Framing: known bytes, and a scanner that must find every complete packet.

#include "drivers/pioneer/packet.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "tests/drivers/pioneer/stream.hpp"

namespace azimuth::pioneer {
namespace {

using test::ByteVector;
using testing::ElementsAre;
using namespace std::chrono_literals;

rc::Gen<ByteVector> any_data() {
  return rc::gen::mapcat(rc::gen::inRange<std::size_t>(1, 60), [](std::size_t size) {
    return rc::gen::container<ByteVector>(size, rc::gen::arbitrary<std::uint8_t>());
  });
}

/// Noise with many packet headers.
rc::Gen<ByteVector> any_noise() {
  return rc::gen::container<ByteVector>(rc::gen::weightedOneOf<std::uint8_t>(
      {{2, rc::gen::element<std::uint8_t>(0xFA, 0xFB)}, {1, rc::gen::arbitrary<std::uint8_t>()}}));
}

TEST(PioneerPacket, SyncPacketsHaveTheKnownBytes) {
  EXPECT_THAT(test::to_vector(encode_frame(ByteVector{0}).view()), ElementsAre(0xFA, 0xFB, 3, 0, 0, 0));
  EXPECT_THAT(test::to_vector(encode_frame(ByteVector{1}).view()), ElementsAre(0xFA, 0xFB, 3, 1, 0, 1));
  EXPECT_THAT(test::to_vector(encode_frame(ByteVector{2}).view()), ElementsAre(0xFA, 0xFB, 3, 2, 0, 2));
}

TEST(PioneerPacket, ChecksumSumsWordsAndXorsAnOddByte) {
  EXPECT_EQ(checksum(ByteVector{0x12, 0x34}), 0x1234);
  EXPECT_EQ(checksum(ByteVector{0x12, 0x34, 0xFF, 0xFF}), 0x1233);  // the carry is lost
  EXPECT_EQ(checksum(ByteVector{0x12, 0x34, 0x35}), 0x1201);        // xored, not added: 0x34 ^ 0x35
  EXPECT_EQ(checksum(ByteVector{}), 0);
}

RC_GTEST_PROP(PioneerPacket, EveryPacketIsFoundHoweverItIsCut, ()) {
  const auto packets = *rc::gen::container<std::vector<ByteVector>>(any_data());
  const auto piece = *rc::gen::inRange<std::size_t>(1, 200);
  ByteVector stream;
  for (const auto& data : packets) test::append(stream, encode_frame(data).view());
  PacketScanner scanner;
  RC_ASSERT(test::scan(scanner, stream, piece) == packets);
  RC_ASSERT(scanner.skipped_bytes() == 0U);
  RC_ASSERT(scanner.bad_checksums() == 0U);
}

// The stream has two packets, because noise may happen to start a valid packet that ends inside the first one.
RC_GTEST_PROP(PioneerPacket, NoiseHidesNoPacketBehindIt, ()) {
  const ByteVector data{0x32, 1, 2, 3, 4, 5, 6, 7};
  ByteVector stream = *any_noise();
  for (int i = 0; i < 2; ++i) test::append(stream, encode_frame(data).view());
  PacketScanner scanner;
  const auto found = test::scan(scanner, stream, *rc::gen::inRange<std::size_t>(1, 100));
  RC_ASSERT(!found.empty());
  RC_ASSERT(found.back() == data);
}

RC_GTEST_PROP(PioneerPacket, EveryByteIsOfAPacketOrSkippedOrInHand, ()) {
  const auto stream = *any_noise();
  PacketScanner scanner;
  std::size_t in_packets = 0;
  for (const auto& data : test::scan(scanner, stream)) in_packets += data.size() + kFrameOverhead;
  scanner.clear();
  RC_ASSERT(in_packets + scanner.skipped_bytes() == stream.size());
}

TEST(PioneerPacket, OfABadPacketOnlyTheFirstByteIsGivenUp) {
  ByteVector stream{0xFA, 0xFB, 20, 0x32};  // announces 20 bytes and extends into the next packet
  const ByteVector good{0x33, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
  test::append(stream, encode_frame(good).view());
  PacketScanner scanner;
  EXPECT_THAT(test::scan(scanner, stream), ElementsAre(good));
  EXPECT_EQ(scanner.bad_checksums(), 1U);
  EXPECT_EQ(scanner.skipped_bytes(), 4U);
}

TEST(PioneerPacket, AFalseLengthDelaysNoPacket) {
  ByteVector stream{0xFA, 0xFB, 255};
  test::append(stream, encode_frame(ByteVector{0x32, 7}).view());
  PacketScanner scanner;
  EXPECT_THAT(test::scan(scanner, stream, 1), ElementsAre(ByteVector{0x32, 7}));
}

TEST(PioneerPacket, LengthsBelowThreeAreNoPackets) {
  for (std::uint8_t length = 0; length < 3; ++length) {
    ByteVector stream{0xFA, 0xFB, length};
    test::append(stream, encode_frame(ByteVector{9}).view());
    PacketScanner scanner;
    EXPECT_THAT(test::scan(scanner, stream), ElementsAre(ByteVector{9}));
    EXPECT_EQ(scanner.skipped_bytes(), 3U);
  }
}

TEST(PioneerPacket, TheLongestPacketIsFound) {
  const ByteVector data(kMaxDataSize, 0x5A);
  const Frame frame = encode_frame(data);
  EXPECT_EQ(frame.size, kMaxFrameSize);
  EXPECT_EQ(frame.bytes[2], 255);
  PacketScanner scanner;
  EXPECT_THAT(test::scan(scanner, frame.view()), ElementsAre(data));
}

TEST(PioneerPacket, ABadChecksumIsBelievedOnRequest) {
  Frame frame = encode_frame(ByteVector{0x20, 'x'});
  frame.bytes[frame.size - 1] ^= 1U;
  PacketScanner scanner([](ByteView data) { return data.front() == 0x20; });
  scanner.add(frame.view(), {});
  const auto packet = scanner.next();
  ASSERT_TRUE(packet);
  EXPECT_FALSE(packet->verified);
  EXPECT_EQ(packet->id(), 0x20);
  EXPECT_EQ(scanner.bad_checksums(), 1U);
  EXPECT_EQ(scanner.skipped_bytes(), 0U);
}

TEST(PioneerPacket, IsDatedByItsFirstByte) {
  const Frame frame = encode_frame(ByteVector{0x32, 1, 2, 3});
  const Clock::time_point start{1s};
  PacketScanner scanner;
  scanner.add(frame.view().first(4), start, 1ms);
  ASSERT_FALSE(scanner.next());
  scanner.add(frame.view().subspan(4), start + 50ms, 1ms);
  const auto packet = scanner.next();
  ASSERT_TRUE(packet);
  EXPECT_EQ(packet->first_byte_at, start - 3ms);  // three later bytes arrived together with it
}

}  // namespace
}  // namespace azimuth::pioneer
