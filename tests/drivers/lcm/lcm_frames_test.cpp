#include "drivers/lcm/lcm_frames.hpp"

#include <azimuth/image_t.hpp>
#include <gtest/gtest.h>
#include <random>

#include "drivers/wire/image_message.hpp"
#include "drivers/wire/messages.hpp"
#include "tests/drivers/lcm/datagrams.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

constexpr LcmPeer kCamera = 1, kStranger = 2, kThird = 3;

class LcmFramesTest : public ::testing::Test {
 protected:
  image_t image(std::uint8_t filling, int width_px = 64, int height_px = 48) const {
    std::vector<std::byte> pixels(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px),
                                  std::byte{filling});
    image_t message{};
    fill_message({packed_format(PixelFormat::gray8, width_px, height_px), pixels}, now_, message);
    return message;
  }
  static std::vector<std::byte> bytes_of(const image_t& message) {
    std::vector<std::byte> bytes;
    encode(message, bytes);
    return bytes;
  }
  std::vector<test::Datagram> parts_of(const image_t& message) {
    return test::in_parts(++message_, "CAMERA", bytes_of(message), 1000);
  }
  void offer(const test::Datagram& datagram, LcmPeer sender = kCamera) {
    test::offer(frames_, datagram, sender, {now_ + 5ms, {}});
  }
  /// Sends a message in one datagram and advances the time by 100 ms.
  void send(const image_t& message, LcmPeer sender = kCamera) {
    offer(test::whole_message(++message_, "CAMERA", bytes_of(message)), sender);
    now_ += 100ms;
  }
  void send_in_parts(const image_t& message, LcmPeer sender = kCamera) {
    for (const auto& part : parts_of(message)) offer(part, sender);
    now_ += 100ms;
  }
  bool takes(Frame& into) { return frames_.take(into); }
  int filling_of_next() {
    Frame frame;
    return frames_.take(frame) ? std::to_integer<int>(frame.bytes().front()) : -1;
  }

  Stamp now_ = stamp_from_us(1'700'000'000'000'000);
  std::uint32_t message_ = 0;
  LcmSourceSettings settings_ = [] {
    LcmSourceSettings settings;
    settings.max_frame_mb = 0.02;
    return settings;
  }();
  LcmFrames frames_{settings_};
};

TEST_F(LcmFramesTest, HandsImagesOnWholeOrInParts) {
  const Stamp start = now_;
  Frame frame;
  send(image(7));
  ASSERT_TRUE(takes(frame));
  EXPECT_EQ(frame.stamp, start);
  EXPECT_EQ(frame.format(), packed_format(PixelFormat::gray8, 64, 48));
  ASSERT_EQ(frame.bytes().size(), 64U * 48U);
  EXPECT_TRUE(std::ranges::all_of(frame.bytes(), [](std::byte pixel) { return pixel == std::byte{7}; }));
  const std::uint64_t first = frame.sequence;
  send_in_parts(image(8));
  ASSERT_TRUE(takes(frame));
  EXPECT_TRUE(std::ranges::all_of(frame.bytes(), [](std::byte pixel) { return pixel == std::byte{8}; }));
  EXPECT_EQ(frame.sequence, first + 1);
  EXPECT_FALSE(takes(frame));
}

TEST_F(LcmFramesTest, PartsMayComeInAnyOrderAfterTheFirstAndTwice) {
  std::mt19937 random(1);
  for (std::uint8_t i = 0; i < 20; ++i, now_ += 100ms) {
    auto parts = parts_of(image(i));
    parts.insert(parts.end(), parts.begin(), parts.end());
    std::shuffle(parts.begin() + 1, parts.end(), random);
    // A part may repeat only while its image is incomplete; afterwards a repeated first part would start another image.
    for (const auto& part : parts) {
      const bool is_done = frames_.counts().frames == i + 1U;
      if (!is_done) offer(part);
    }
    EXPECT_EQ(filling_of_next(), i);
  }
}

TEST_F(LcmFramesTest, JpegImagesHaveTheSizeTheyHave) {
  for (const std::size_t size : {100U, 5000U, 1U}) {
    image_t message = image(0);
    message.pixelformat = image_t::PIXEL_FORMAT_MJPEG;
    message.row_stride = 0;
    message.data.assign(size, 1);
    message.size = static_cast<std::int32_t>(size);
    send(message);
    Frame frame;
    ASSERT_TRUE(takes(frame));
    EXPECT_EQ(frame.format().pixels, PixelFormat::mjpeg);
    EXPECT_EQ(frame.bytes().size(), size);
  }
}

TEST_F(LcmFramesTest, AnImageWithLostPartsIsAGap) {
  send_in_parts(image(1));
  Frame frame;
  ASSERT_TRUE(takes(frame));
  const std::uint64_t first = frame.sequence;
  for (std::uint8_t i = 0; i < 2; ++i, now_ += 100ms) {
    auto parts = parts_of(image(2));
    parts.erase(parts.begin() + 1 + i);
    for (const auto& part : parts) offer(part);
  }
  send_in_parts(image(3));
  ASSERT_TRUE(takes(frame));
  EXPECT_EQ(frame.bytes().front(), std::byte{3});
  EXPECT_EQ(frame.sequence, first + 3);
  EXPECT_EQ(frames_.counts().incomplete, 2U);
}

TEST_F(LcmFramesTest, PartsWithoutAFirstAndOfOtherChannelsAreNothing) {
  auto parts = parts_of(image(1));
  for (std::size_t i = 1; i < parts.size(); ++i) offer(parts[i]);
  for (const auto& part : test::in_parts(99, "CAMERA2", bytes_of(image(1)), 1000)) offer(part);
  offer(test::whole_message(100, "CAMER", bytes_of(image(1))));
  EXPECT_EQ(filling_of_next(), -1);
  EXPECT_EQ(frames_.counts().malformed, 0U);
  send(image(2));
  EXPECT_EQ(filling_of_next(), 2);
}

TEST_F(LcmFramesTest, PartsThatContradictEachOtherAreLeftOut) {
  const auto bytes = bytes_of(image(1));
  auto parts = test::in_parts(1, "CAMERA", bytes, 1000);
  const auto size = static_cast<std::uint32_t>(bytes.size());
  const auto count = static_cast<std::uint16_t>(parts.size());
  offer(parts[0]);
  offer(test::one_part({1, size + 1, 1000, 1, count}, "", Bytes(bytes).first(1000)));
  offer(test::one_part({1, size, 1000, 1, static_cast<std::uint16_t>(count + 1)}, "", Bytes(bytes).first(1000)));
  for (std::size_t i = 1; i < parts.size(); ++i) offer(parts[i]);
  EXPECT_EQ(filling_of_next(), 1);
  // All parts arrive, but not all bytes.
  now_ += 100ms;
  parts = test::in_parts(2, "CAMERA", bytes_of(image(2)), 1000);
  parts.back() = test::one_part({2, size, 0, static_cast<std::uint16_t>(count - 1), count}, "", {});
  for (const auto& part : parts) offer(part);
  EXPECT_EQ(filling_of_next(), -1);
  EXPECT_EQ(frames_.counts().malformed, 1U);
}

TEST_F(LcmFramesTest, WhatCannotBeAnImageIsCounted) {
  image_t message = image(1);
  message.width = 100'000;
  send(message);
  message = image(1);
  message.height = -48;
  send(message);
  message = image(1);
  message.height = 49;  // more rows than the bytes allow
  send(message);
  send_in_parts(message);
  offer(test::whole_message(9, "CAMERA", {}));
  auto bytes = bytes_of(image(1));
  bytes[0] ^= std::byte{1};
  offer(test::whole_message(9, "CAMERA", bytes));
  EXPECT_EQ(frames_.counts().malformed, 6U);
  message = image(1);
  message.pixelformat = 1;
  send(message);
  EXPECT_EQ(frames_.counts().unsupported, 1U);
  message.pixelformat = image_t::PIXEL_FORMAT_MJPEG;
  message.data.clear();
  message.size = 0;
  send(message);
  EXPECT_EQ(frames_.counts().malformed, 7U) << "an image that could not be read when it was sent";
  EXPECT_EQ(filling_of_next(), -1);
  for (unsigned i = 0; i < 2 * LcmFrames::kSlots; ++i) {
    send(image(5));
    EXPECT_EQ(filling_of_next(), 5) << "no slot was lost";
  }
}

TEST_F(LcmFramesTest, ImagesLargerThanTheMemorySetAsideAreCounted) {
  send_in_parts(image(1, 200, 150));
  EXPECT_EQ(frames_.counts().too_large, 1U);
  offer(test::one_part({77, 10, 0, 0, LcmFrames::kMaxParts + 1}, "CAMERA", {}));
  EXPECT_EQ(frames_.counts().too_large, 2U);
  send_in_parts(image(2, 190, 100));
  EXPECT_EQ(filling_of_next(), 2);
}

TEST_F(LcmFramesTest, TheNewestWinsAndNoSlotIsLost) {
  for (std::uint8_t i = 0; i < 40; ++i) send_in_parts(image(i));
  EXPECT_EQ(filling_of_next(), 39);
  EXPECT_EQ(frames_.counts().replaced, 39U);
  EXPECT_EQ(frames_.counts().no_room, 0U);
}

TEST_F(LcmFramesTest, WithAllSlotsLeasedImagesAreDropped) {
  std::vector<Frame> held(LcmFrames::kSlots);
  for (std::uint8_t i = 0; i < LcmFrames::kSlots; ++i) {
    send(image(i));
    ASSERT_TRUE(takes(held[i]));
  }
  send(image(99));
  EXPECT_EQ(filling_of_next(), -1);
  EXPECT_EQ(frames_.counts().no_room, 1U);
  EXPECT_EQ(held[0].bytes().front(), std::byte{0}) << "untouched";
  held[3] = Frame{};
  send(image(100));
  EXPECT_EQ(filling_of_next(), 100);
}

TEST_F(LcmFramesTest, FramesOutliveTheReceiver) {
  Frame frame;
  {
    LcmFrames frames(settings_);
    test::offer(frames, test::whole_message(1, "CAMERA", bytes_of(image(4))), kCamera, {now_, {}});
    ASSERT_TRUE(frames.take(frame));
  }
  EXPECT_EQ(frame.bytes().back(), std::byte{4});
}

TEST_F(LcmFramesTest, OneSenderAtATime) {
  send(image(1));
  send(image(2), kStranger);
  send_in_parts(image(3), kStranger);
  EXPECT_EQ(filling_of_next(), 1);
  EXPECT_EQ(frames_.counts().other_senders, 2U);
  now_ += 1s;
  send(image(4), kStranger);
  EXPECT_EQ(filling_of_next(), 4);
  EXPECT_EQ(frames_.senders(), 2U);
}

TEST_F(LcmFramesTest, MessagesOfSeveralSendersBegunAtOnceDoNotMix) {
  const auto one = parts_of(image(1)), other = parts_of(image(2)), third = parts_of(image(3));
  for (std::size_t i = 0; i < one.size(); ++i) {
    offer(one[i], kCamera);
    offer(other[i], kStranger);
    offer(third[i], kThird);
  }
  Frame frame;
  ASSERT_TRUE(takes(frame));
  const std::byte filling = frame.bytes().front();
  EXPECT_TRUE(std::ranges::all_of(frame.bytes(), [&](std::byte pixel) { return pixel == filling; }));
  EXPECT_EQ(frames_.counts().frames, 1U);
}

TEST_F(LcmFramesTest, WrongStampsAreCountedAndDropped) {
  send(image(1));
  image_t old = image(2);
  old.utime -= 5'000'000;
  send(old);
  image_t late = image(2);
  late.utime -= 250'000;
  send(late);
  EXPECT_EQ(filling_of_next(), 1);
  EXPECT_EQ(filling_of_next(), -1);
  EXPECT_EQ(frames_.stamp_counts().too_old, 1U);
  EXPECT_EQ(frames_.stamp_counts().out_of_order, 1U);
}

TEST_F(LcmFramesTest, AllocatesNothingInTheSteadyState) {
  std::vector<std::vector<test::Datagram>> images;
  std::vector<Stamp> stamps;
  for (std::uint8_t i = 0; i < 50; ++i, now_ += 100ms) {
    images.push_back(parts_of(image(i)));
    stamps.push_back(now_);
  }
  Frame frame;
  std::size_t taken = 0;
  const std::size_t before = allocations();
  for (std::size_t i = 0; i < images.size(); ++i) {
    for (const auto& part : images[i]) test::offer(frames_, part, kCamera, {stamps[i], {}});
    taken += frames_.take(frame) ? 1 : 0;
  }
  EXPECT_EQ(allocations(), before);
  EXPECT_EQ(taken, 50U);
}

}  // namespace
}  // namespace azimuth
