#include "drivers/can/can_frame.hpp"

#include <gtest/gtest.h>
#include <linux/can.h>
#include <rapidcheck/gtest.h>
#include <vector>

namespace azimuth {
namespace {

using Octets = std::vector<std::uint8_t>;

/// The memory of a struct can_frame on a little-endian machine.
Octets classic(std::uint32_t id_word, std::uint8_t length, Octets data) {
  Octets bytes{static_cast<std::uint8_t>(id_word),
               static_cast<std::uint8_t>(id_word >> 8U),
               static_cast<std::uint8_t>(id_word >> 16U),
               static_cast<std::uint8_t>(id_word >> 24U),
               length,
               0,
               0,
               0};
  data.resize(8);
  bytes.insert(bytes.end(), data.begin(), data.end());
  return bytes;
}

TEST(CanFrame, ReadsClassicFrames) {
  const auto frame = decode_can_frame(classic(0x181, 3, {1, 2, 3}));
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->id, (CanId{0x181, false}));
  EXPECT_EQ(frame->kind, CanFrame::Kind::data);
  EXPECT_FALSE(frame->fd);
  EXPECT_EQ(Octets(frame->bytes().begin(), frame->bytes().end()), (Octets{1, 2, 3}));
}

TEST(CanFrame, TellsExtendedIdsFromStandardOnes) {
  EXPECT_EQ(decode_can_frame(classic(0x80000181U, 0, {}))->id, (CanId{0x181, true}));
  EXPECT_EQ(decode_can_frame(classic(0x9FFFFFFFU, 0, {}))->id, (CanId{0x1FFFFFFF, true}));
  EXPECT_NE((CanId{0x181, true}), (CanId{0x181, false}));
}

TEST(CanFrame, RemoteFramesHaveALengthAndNoData) {
  const auto frame = decode_can_frame(classic(0x40000181U, 8, {9, 9}));
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->kind, CanFrame::Kind::remote);
  EXPECT_TRUE(frame->bytes().empty());
}

TEST(CanFrame, ErrorFramesKeepTheirClasses) {
  const auto frame = decode_can_frame(classic(0x20000004U | 0x40U, 8, {0, 0x10}));
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->kind, CanFrame::Kind::error);
  EXPECT_EQ(frame->id.number, 0x44U);
  EXPECT_EQ(frame->data[1], 0x10);
}

TEST(CanFrame, ReadsFramesOfCanFd) {
  Octets bytes = classic(0x181, 64, {});
  bytes.resize(72, 0xAB);
  const auto frame = decode_can_frame(bytes);
  ASSERT_TRUE(frame);
  EXPECT_TRUE(frame->fd);
  EXPECT_EQ(frame->bytes().size(), 64U);
  EXPECT_EQ(frame->bytes().back(), 0xAB);
}

TEST(CanFrame, RefusesEveryOtherSizeAndImpossibleLengths) {
  for (std::size_t size = 0; size < 100; ++size) {
    if (size == 16 || size == 72) continue;
    EXPECT_FALSE(decode_can_frame(Octets(size))) << size;
  }
  for (unsigned length = 9; length < 256; ++length)
    EXPECT_FALSE(decode_can_frame(classic(1, static_cast<std::uint8_t>(length), {}))) << length;
  Octets fd(72);
  for (unsigned length = 65; length < 256; ++length) {
    fd[4] = static_cast<std::uint8_t>(length);
    EXPECT_FALSE(decode_can_frame(fd)) << length;
  }
}

RC_GTEST_PROP(CanFrame, IsReadAsItWasWritten, ()) {
  CanFrame frame;
  frame.fd = *rc::gen::arbitrary<bool>();
  frame.id.extended = *rc::gen::arbitrary<bool>();
  frame.id.number = *rc::gen::arbitrary<std::uint32_t>() & largest_can_id(frame.id.extended);
  frame.size = *rc::gen::inRange<std::uint8_t>(0, frame.fd ? 65 : 9);
  for (std::size_t i = 0; i < frame.size; ++i) frame.data.at(i) = *rc::gen::arbitrary<std::uint8_t>();
  std::array<std::uint8_t, kMostCanSocketBytes> datagram{};
  const std::size_t size = encode_can_frame(frame, datagram);
  RC_ASSERT(decode_can_frame(std::span(datagram).first(size)) == frame);
}

}  // namespace
}  // namespace azimuth
