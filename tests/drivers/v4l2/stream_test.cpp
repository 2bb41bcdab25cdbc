#include <cerrno>
#include <gmock/gmock.h>
#include <poll.h>

#include "drivers/camera/camera_driver.hpp"
#include "drivers/v4l2/v4l2_stream.hpp"
#include "tests/drivers/v4l2/fake_v4l2.hpp"
#include "tests/drivers/v4l2/stream_fixture.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using Read = ImageStream::Read;
using test::V4l2StreamTest;

TEST_F(V4l2StreamTest, HandsImagesOnAsTheyAre) {
  open();
  EXPECT_FALSE(is_readable());
  EXPECT_EQ(read(), Read::nothing);
  ASSERT_TRUE(device_.fill({.sequence = 7, .stamp_us = 12'345'678, .value = 42}));
  EXPECT_TRUE(is_readable());
  ASSERT_EQ(read(), Read::image);
  EXPECT_EQ(frame_.stamp, stamp_from_us(12'345'678));
  EXPECT_EQ(frame_.format(), packed_format(PixelFormat::yuyv, 640, 480));
  EXPECT_EQ(frame_.bytes().size(), 640U * 480 * 2);
  EXPECT_EQ(frame_.bytes().front(), std::byte{42});
  EXPECT_EQ(frame_.bytes().back(), std::byte{42});
  EXPECT_EQ(stream().description().name, "Fake Camera");
  EXPECT_EQ(stream().description().usb_port, "1-2");
  EXPECT_EQ(read(), Read::nothing);
}

TEST_F(V4l2StreamTest, SequenceNumbersGoOnBeyond32Bits) {
  open();
  std::vector<std::uint64_t> numbers;
  for (const std::uint32_t sequence : {0xFFFFFFFDU, 0xFFFFFFFEU, 1U, 2U}) {
    ASSERT_TRUE(device_.fill({.sequence = sequence}));
    ASSERT_EQ(read(), Read::image);
    numbers.push_back(frame_.sequence);
  }
  EXPECT_EQ(numbers[1] - numbers[0], 1U);
  EXPECT_EQ(numbers[2] - numbers[1], 3U);
  EXPECT_EQ(numbers[3] - numbers[2], 1U);
}

TEST_F(V4l2StreamTest, FramesGivenBackAreQueuedAgain) {
  open();
  EXPECT_EQ(device_.queued(), 4U);
  std::vector<Frame> held(4);
  for (Frame& frame : held) {
    ASSERT_TRUE(device_.fill({}));
    ASSERT_EQ(stream().read(frame), Read::image);
  }
  EXPECT_FALSE(device_.fill({})) << "all are leased";
  EXPECT_FALSE(is_readable());
  held[2] = Frame{};
  EXPECT_TRUE(is_readable()) << "or the device would starve until somebody looks";
  EXPECT_EQ(read(), Read::nothing);
  EXPECT_EQ(device_.queued(), 1U);
  EXPECT_FALSE(is_readable());
  EXPECT_TRUE(device_.fill({}));
}

TEST_F(V4l2StreamTest, DamagedImagesAreDroppedAndTheirBuffersQueuedAgain) {
  open();
  const std::uint32_t whole = 640 * 480 * 2;
  const std::vector<test::FakeFill> damaged{{.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_ERROR},
                                            {.bytesused = 0U},
                                            {.bytesused = whole - 1},
                                            {.bytesused = whole + 1},
                                            {.bytesused = 0xFFFFFFFFU}};
  for (const test::FakeFill& image : damaged) {
    ASSERT_TRUE(device_.fill(image));
    EXPECT_EQ(read(), Read::corrupt);
    EXPECT_FALSE(frame_);
    EXPECT_EQ(device_.queued(), 4U);
  }
}

TEST_F(V4l2StreamTest, CompressedImagesMayBeOfAnyLengthButMustBeginAsOne) {
  open({.formats = "MJPG"});
  ASSERT_TRUE(device_.fill({.bytesused = 1000U}));
  ASSERT_EQ(read(), Read::image);
  EXPECT_EQ(frame_.bytes().size(), 1000U);
  EXPECT_EQ(frame_.format(), packed_format(PixelFormat::mjpeg, 640, 480));
  for (const auto& [used, value] : std::vector<std::pair<std::uint32_t, int>>{{0, 0}, {2, 0}, {1000, 9}, {999999, 0}}) {
    ASSERT_TRUE(device_.fill({.bytesused = used, .value = value}));
    EXPECT_EQ(read(), Read::corrupt) << used;
  }
}

TEST_F(V4l2StreamTest, WithPlanesTheImageMayBeginLaterInItsBuffer) {
  device_.capabilities = V4L2_CAP_VIDEO_CAPTURE_MPLANE | V4L2_CAP_STREAMING;
  device_.buffer_bytes = 640 * 480 * 2 + 100;
  open();
  const std::uint32_t whole = 640 * 480 * 2;
  ASSERT_TRUE(device_.fill({.bytesused = whole + 64, .data_offset = 64}));
  ASSERT_EQ(read(), Read::image);
  EXPECT_EQ(frame_.bytes().size(), whole);
  ASSERT_TRUE(device_.fill({.bytesused = whole, .data_offset = 64}));
  EXPECT_EQ(read(), Read::corrupt);
  ASSERT_TRUE(device_.fill({.bytesused = whole, .data_offset = 0xFFFFFFF0U}));
  EXPECT_EQ(read(), Read::corrupt);
}

TEST_F(V4l2StreamTest, AnotherClocksStampsAreReplacedByTheTimeOfDequeueing) {
  device_.stamp_flags = V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN;
  open();
  EXPECT_THAT(stream().description().refused, testing::ElementsAre(HasSubstr("monotonic clock")));
  device_.clock += 5s;
  ASSERT_TRUE(device_.fill({.stamp_us = 1, .flags = V4L2_BUF_FLAG_TIMESTAMP_COPY}));
  ASSERT_EQ(read(), Read::image);
  EXPECT_EQ(frame_.stamp, stamp_from_us(1'005'000'000));
}

TEST_F(V4l2StreamTest, AStampThatFitsTheMonotonicClockIsBelievedWhereTheDriverIsSilentOnIt) {
  device_.stamp_flags = V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN;
  open();
  device_.clock += 5s;
  const std::int64_t now_us = 1'005'000'000;
  for (const auto& [stamp_us, believed_us] :
       std::vector<std::pair<std::int64_t, std::int64_t>>{{now_us, now_us},
                                                          {now_us - 60'000, now_us - 60'000},
                                                          {now_us - 1'000'001, now_us},
                                                          {now_us + 1, now_us},
                                                          {1'700'000'000'000'000, now_us}}) {
    ASSERT_TRUE(device_.fill({.stamp_us = stamp_us, .flags = V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN}));
    ASSERT_EQ(read(), Read::image);
    EXPECT_EQ(frame_.stamp, stamp_from_us(believed_us)) << stamp_us;
  }
}

TEST_F(V4l2StreamTest, WhatLayInTheBuffersBeforeTheStreamIsPassedOver) {
  device_.stamp_flags = V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN;
  open();
  device_.clock += 50ms;
  const auto fill = [this](std::uint32_t sequence, std::int64_t stamp_us) {
    return device_.fill({.sequence = sequence, .stamp_us = stamp_us, .flags = V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN});
  };
  ASSERT_TRUE(fill(0, 999'999'999));
  ASSERT_TRUE(fill(0, 999'999'999));
  ASSERT_TRUE(fill(17, 1'000'000'100));
  ASSERT_EQ(read(), Read::image);
  EXPECT_EQ(frame_.stamp, stamp_from_us(1'000'000'100));
  const std::uint64_t first = frame_.sequence;
  ASSERT_TRUE(fill(18, 1'000'050'000));
  ASSERT_EQ(read(), Read::image);
  EXPECT_EQ(frame_.sequence, first + 1);
  ASSERT_TRUE(fill(0, 999'999'999));
  EXPECT_EQ(read(), Read::nothing);
}

TEST_F(V4l2StreamTest, AnImageOverOneThatIsHeldIsLostAndNoMore) {
  open();
  Frame held;
  ASSERT_TRUE(device_.fill({.sequence = 1}));
  ASSERT_EQ(stream().read(held), Read::image);
  const std::uint64_t first = held.sequence;
  ASSERT_TRUE(device_.fill({.sequence = 2, .index = 0U}));
  EXPECT_EQ(read(), Read::corrupt);
  held = Frame{};
  ASSERT_TRUE(device_.fill({.sequence = 3}));
  ASSERT_EQ(read(), Read::image);
  EXPECT_EQ(frame_.sequence, first + 2);
  ASSERT_TRUE(device_.fill({.sequence = 4, .index = 0U})) << "which is back";
  EXPECT_EQ(read(), Read::image);
}

TEST_F(V4l2StreamTest, NothingAllocatesPerFrame) {
  open();
  const auto round = [&](std::uint32_t number) {
    return stream().read(frame_) == Read::image ? 1 : static_cast<int>(number) * 0;
  };
  int images = 0;
  for (std::uint32_t i = 0; i < 100; ++i) {
    ASSERT_TRUE(device_.fill({.sequence = i}));
    const std::size_t before = allocations();
    images += round(i);
    ASSERT_EQ(allocations(), before);
  }
  EXPECT_EQ(images, 100);
}

TEST_F(V4l2StreamTest, GapsAreCountedExactly) {
  CameraDriver driver({}, [&] { return open_v4l2({.buffers = 4}, device_); });
  std::uint64_t lost = 0, damaged = 0;
  std::uint32_t sequence = 0;
  for (int i = 0; i < 101; ++i) {
    device_.clock += 33ms;
    if (i > 0) {
      const std::uint32_t skip = i % 7 == 3 ? static_cast<std::uint32_t>(i % 4) : 0;
      sequence += 1 + skip;
      lost += sequence > 0 && i > 1 ? skip : 0;
      const bool is_damaged = i % 10 == 9;
      damaged += is_damaged ? 1 : 0;
      const auto us = std::chrono::duration_cast<std::chrono::microseconds>(device_.clock.time_since_epoch()).count();
      const std::uint32_t error = is_damaged ? V4L2_BUF_FLAG_ERROR : 0U;
      ASSERT_TRUE(
          device_.fill({.sequence = sequence, .stamp_us = us, .flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | error}));
    }
    driver.turn(device_.clock);
    driver.take(frame_);
    frame_ = Frame{};
  }
  EXPECT_EQ(driver.state().missing, lost);
  EXPECT_EQ(driver.state().corrupt, damaged);
  EXPECT_EQ(driver.state().images, 100 - damaged);
  EXPECT_GT(lost, 10U);
}

}  // namespace
}  // namespace azimuth
