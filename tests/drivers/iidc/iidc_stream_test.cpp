// Frames from the ring as leases.

#include <array>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <gmock/gmock.h>
#include <poll.h>

#include "tests/drivers/iidc/iidc_bench.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth::test {
namespace {

constexpr std::int64_t kInterval_us = 33'333;  // at the highest rate of the stand-in's modes

std::int64_t now_us() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000 + now.tv_nsec / 1000;
}

class IidcStreamTest : public IidcBench {
 protected:
  /// Sends frames at the regular interval, the last one at the start of the test.
  static void send_in_time(std::initializer_list<std::uint8_t> numbers) {
    auto left = static_cast<std::int64_t>(numbers.size());
    for (const std::uint8_t number : numbers) fake().send(number, --left * kInterval_us);
  }

  const std::int64_t start_us_ = now_us();  // just after the stand-in's start
};

TEST_F(IidcStreamTest, ImagesComeInOrderWithStampsAndNumbers) {
  ASSERT_TRUE(open()) << trouble_.text;
  EXPECT_TRUE(fake().transmitting);
  EXPECT_EQ(read(), Read::nothing);
  EXPECT_FALSE(frame_);
  send_in_time({11, 12, 13});
  for (std::uint64_t i = 0; i < 3; ++i) {
    ASSERT_EQ(read(), Read::image);
    EXPECT_TRUE(is_filled_with(frame_, static_cast<std::uint8_t>(11 + i)));
    EXPECT_EQ(frame_.bytes().size(), 640U * 480U);
    EXPECT_EQ(frame_.format(), stream_->description().format);
    EXPECT_EQ(frame_.sequence, i);
    const std::int64_t age_us = static_cast<std::int64_t>(2 - i) * kInterval_us;
    EXPECT_NEAR(static_cast<double>(to_us(frame_.stamp)), static_cast<double>(start_us_ - age_us), 20'000.0);
  }
  EXPECT_EQ(read(), Read::nothing);
}

TEST_F(IidcStreamTest, TheDescriptorTellsOfFrames) {
  ASSERT_TRUE(open());
  pollfd event{stream_->descriptor(), stream_->poll_events(), 0};
  EXPECT_EQ(::poll(&event, 1, 0), 0);
  fake().send(1);
  EXPECT_EQ(::poll(&event, 1, 0), 1);
  EXPECT_EQ(read(), Read::image);
  EXPECT_EQ(::poll(&event, 1, 0), 0);
}

TEST_F(IidcStreamTest, DescribesTheCamera) {
  ASSERT_TRUE(open());
  const StreamDescription& description = stream_->description();
  EXPECT_EQ(description.device, "00b09d0100c0ffee");
  EXPECT_EQ(description.name, "Bench VCAM-1");
  EXPECT_EQ(description.format, packed_format(PixelFormat::gray8, 640, 480));
  EXPECT_EQ(description.rate_hz, 30.0);
  EXPECT_EQ(description.usb_port, "");
  EXPECT_EQ(refused(), "");
}

TEST_F(IidcStreamTest, FramesMissingInBetweenShowAsGaps) {
  ASSERT_TRUE(open());
  std::vector<std::uint64_t> sequences;
  for (const int ago : {20, 19, 18, 14, 13, 6, 5}) {
    fake().send(1, ago * kInterval_us);
    ASSERT_EQ(read(), Read::image);
    sequences.push_back(frame_.sequence);
  }
  EXPECT_THAT(sequences, testing::ElementsAre(0, 1, 2, 6, 7, 14, 15));
}

TEST_F(IidcStreamTest, CorruptFramesAreDroppedAndCountAsFrames) {
  ASSERT_TRUE(open());
  fake().send(1, 2 * kInterval_us);
  fake().send(2, kInterval_us, true);
  fake().send(3);
  EXPECT_EQ(read(), Read::image);
  EXPECT_EQ(read(), Read::corrupt);
  EXPECT_FALSE(frame_);
  EXPECT_EQ(read(), Read::image);
  EXPECT_EQ(frame_.sequence, 2U);
  EXPECT_TRUE(is_filled_with(frame_, 3));
  fake().wrong_width = 320;
  fake().send(4);
  EXPECT_EQ(read(), Read::corrupt);
  fake().wrong_width = 640;
  fake().ring[4].frame.image_bytes = 640 * 479;
  fake().send(5);
  EXPECT_EQ(read(), Read::corrupt);
}

TEST_F(IidcStreamTest, LeasesDoNotHoldTheRing) {
  settings_.dma_buffers = 4;
  ASSERT_TRUE(open());
  EXPECT_EQ(fake().ring_size(), 4U);
  std::array<Frame, 10> held;
  std::uint8_t number = 0;
  const auto send_next = [&number] {
    ++number;
    fake().send(number, (20 - number) * kInterval_us);
  };
  for (Frame& frame : held) {
    send_next();
    ASSERT_EQ(stream_->read(frame), Read::image);
  }
  // Every buffer is leased: new frames are lost, but the ring continues.
  for (int i = 0; i < 3; ++i) send_next();
  EXPECT_EQ(read(), Read::nothing);
  EXPECT_EQ(fake().lost, 0);
  for (std::size_t i = 0; i < held.size(); ++i)
    EXPECT_TRUE(is_filled_with(held.at(i), static_cast<std::uint8_t>(i + 1)));
  held[3] = Frame{};
  send_next();
  ASSERT_EQ(read(), Read::image);
  EXPECT_TRUE(is_filled_with(frame_, number));
  EXPECT_EQ(frame_.sequence, 13U);
}

TEST_F(IidcStreamTest, WhatTheFrameHeldIsGivenBackFirst) {
  ASSERT_TRUE(open());
  for (int i = 0; i < 40; ++i) {
    fake().send(static_cast<std::uint8_t>(i));
    ASSERT_EQ(read(), Read::image) << i;
  }
}

TEST_F(IidcStreamTest, LeasesOutliveTheStream) {
  ASSERT_TRUE(open());
  send_in_time({7, 8});
  ASSERT_EQ(read(), Read::image);
  Frame second;
  ASSERT_EQ(stream_->read(second), Read::image);
  stream_.reset();
  EXPECT_EQ(fake().captures, 0);  // immediately, so that the camera can be opened again
  EXPECT_TRUE(is_filled_with(frame_, 7));
  EXPECT_TRUE(is_filled_with(second, 8));
  ASSERT_TRUE(open());
  EXPECT_TRUE(is_filled_with(second, 8));
}

TEST_F(IidcStreamTest, OneReadIsBoundedByTheRing) {
  settings_.dma_buffers = 3;
  ASSERT_TRUE(open());
  std::array<Frame, 10> held;
  for (Frame& frame : held) {
    fake().send(1);
    ASSERT_EQ(stream_->read(frame), Read::image);
  }
  for (int i = 0; i < 3; ++i) fake().send(2);
  fake().send(2);
  EXPECT_EQ(fake().lost, 1);
  EXPECT_EQ(read(), Read::nothing);
}

TEST_F(IidcStreamTest, NothingAllocatesPerFrame) {
  ASSERT_TRUE(open());
  fake().send(1);
  ASSERT_EQ(read(), Read::image);
  const std::size_t before = allocations();
  for (int i = 0; i < 100; ++i) {
    fake().send(static_cast<std::uint8_t>(i), 0, i % 10 == 9);
    const Read result = read();
    if (result != (i % 10 == 9 ? Read::corrupt : Read::image) || read() != Read::nothing) FAIL() << i;
  }
  EXPECT_EQ(allocations() - before, 0U);
}

TEST_F(IidcStreamTest, AStampOfNoUseBecomesTheTimeOfReading) {
  ASSERT_TRUE(open());
  fake().send_stamped(1, 0);
  const std::int64_t before_us = now_us();
  ASSERT_EQ(read(), Read::image);
  EXPECT_GE(to_us(frame_.stamp), before_us);
  EXPECT_LE(to_us(frame_.stamp), now_us());
}

}  // namespace
}  // namespace azimuth::test
