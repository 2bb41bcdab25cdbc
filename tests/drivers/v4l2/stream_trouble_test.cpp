// Streams whose camera fails at any call, or is not a camera.

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

TEST_F(V4l2StreamTest, MadBuffersEndTheStream) {
  for (const std::uint32_t index : {4U, 31U, 32U, 0xFFFFFFFFU}) {
    open();
    ASSERT_TRUE(device_.fill({.index = index}));
    EXPECT_EQ(read(), Read::failed) << index;
    EXPECT_THAT(stream().trouble().text, HasSubstr("which it did not have"));
  }
}

TEST_F(V4l2StreamTest, EveryErrorOfDequeueingAndQueueingEndsTheStream) {
  for (const int error : {EIO, ENODEV, EINVAL, EPIPE, EOVERFLOW, ENOMEM, EPROTO}) {
    open();
    device_.failing[VIDIOC_DQBUF] = error;
    EXPECT_EQ(read(), Read::failed);
    EXPECT_EQ(stream().trouble().error_number, error);
    EXPECT_THAT(stream().trouble().text, HasSubstr("VIDIOC_DQBUF: "));
    device_.failing.clear();
  }
  open();
  ASSERT_TRUE(device_.fill({}));
  ASSERT_EQ(read(), Read::image);
  device_.failing[VIDIOC_QBUF] = ENODEV;
  EXPECT_EQ(read(), Read::failed);
  EXPECT_THAT(stream().trouble().text, HasSubstr("VIDIOC_QBUF: No such device"));
}

TEST_F(V4l2StreamTest, AnErrorThatOnlyPollShowsEndsTheStream) {
  for (const int events : {POLLERR, POLLHUP, POLLNVAL}) {
    open();
    device_.poll_events = static_cast<short>(events);
    EXPECT_EQ(read(), Read::failed);
    EXPECT_NE(stream().trouble().text, "");
    device_.poll_events = 0;
  }
}

/// The first n calls succeed and all later ones fail, for every n: opening must report the failure and leave nothing
/// open.
TEST_F(V4l2StreamTest, EveryCallMayFailInTurn) {
  open();
  opened_ = OpenedStream{};
  const int calls = [&] {
    const int before = device_.calls();
    open();
    return device_.calls() - before;
  }();
  opened_ = OpenedStream{};
  ASSERT_GT(calls, 15);
  for (const int error : {EIO, ENODEV, ENOMEM, EINVAL, ENOTTY}) {
    int refusals = 0;
    for (int i = 0; i < calls; ++i) {
      device_.fail_after = device_.calls() + 1 + i;  // opening itself succeeds
      device_.failure = error;
      const OpenedStream opened = open_v4l2({.buffers = 4}, device_);
      if (!opened) {
        ++refusals;
        ASSERT_NE(opened.error().text, "");
        ASSERT_EQ(device_.open_descriptors(), 0) << i;
      }
    }
    device_.fail_after = -1;
    EXPECT_GE(refusals, calls - 2);
    ASSERT_EQ(device_.mapped(), 0U);
    ASSERT_EQ(device_.open_descriptors(), 0);
  }
}

TEST_F(V4l2StreamTest, OneCallThatFailsIsNamed) {
  for (const unsigned long request :
       {VIDIOC_QUERYCAP, VIDIOC_G_FMT, VIDIOC_S_FMT, VIDIOC_REQBUFS, VIDIOC_QUERYBUF, VIDIOC_QBUF, VIDIOC_STREAMON}) {
    opened_ = OpenedStream{};
    device_.failing = {{request, EIO}};
    opened_ = open_v4l2({.device = (device_.nodes() / "video0").string()}, device_);
    EXPECT_FALSE(opened_);
    EXPECT_THAT(opened_.error().text, HasSubstr("video0: VIDIOC_"));
    EXPECT_THAT(opened_.error().text, HasSubstr(": Input/output error"));
    EXPECT_EQ(opened_.error().error_number, EIO);
  }
  device_.failing.clear();
  device_.map_error = ENOMEM;
  opened_ = open_v4l2({}, device_);
  EXPECT_THAT(opened_.error().text, HasSubstr("mmap: Cannot allocate memory"));
}

TEST_F(V4l2StreamTest, OddBuffersAreRefused) {
  device_.most_buffers = 1;
  EXPECT_THAT(open_v4l2({}, device_).error().text, HasSubstr("gives 1 buffers, asked for 6"));
  device_.most_buffers = device_.least_buffers = 33;
  EXPECT_THAT(open_v4l2({}, device_).error().text, HasSubstr("gives 33 buffers"));
  device_.most_buffers = 32;
  device_.least_buffers = 0;
  device_.buffer_bytes = 100;
  EXPECT_THAT(open_v4l2({}, device_).error().text, HasSubstr("too small for an image"));
  EXPECT_EQ(device_.mapped(), 0U);
}

TEST_F(V4l2StreamTest, WhatIsNoCameraIsRefused) {
  device_.capabilities = V4L2_CAP_VIDEO_OUTPUT | V4L2_CAP_STREAMING;
  EXPECT_THAT(open_v4l2({.device = (device_.nodes() / "video0").string()}, device_).error().text,
              HasSubstr("is no camera that streams"));
  device_.capabilities = V4L2_CAP_VIDEO_CAPTURE;  // supports read(2) only
  EXPECT_FALSE(open_v4l2({}, device_));
  EXPECT_EQ(device_.open_descriptors(), 0);
}

TEST_F(V4l2StreamTest, FramesOutliveTheStream) {
  open();
  ASSERT_TRUE(device_.fill({.value = 9}));
  ASSERT_EQ(read(), Read::image);
  opened_ = OpenedStream{};
  EXPECT_FALSE(device_.streaming());
  EXPECT_EQ(device_.buffers(), 0U) << "given up, so that another stream may have some";
  EXPECT_EQ(device_.open_descriptors(), 0);
  EXPECT_EQ(device_.mapped(), 4U);
  EXPECT_EQ(frame_.bytes().front(), std::byte{9});
  open();
  Frame next;
  ASSERT_TRUE(device_.fill({.value = 10}));
  ASSERT_EQ(stream().read(next), Read::image);
  EXPECT_EQ(frame_.bytes().front(), std::byte{9});
  frame_ = Frame{};
  EXPECT_EQ(device_.mapped(), 4U) << "of the second stream";
}

/// The common camera driver on top of this stream.
TEST_F(V4l2StreamTest, IsFoundAgainUnderAnotherNumber) {
  device_.remove_node("video0");
  device_.add_node("video0", "1-2", "1d6b", "0105", "A1");
  CameraDriver driver({}, [&] { return open_v4l2({.device = "serial:A1"}, device_); });
  const auto turn = [&] {
    device_.clock += 50ms;
    driver.turn(device_.clock);
    while (driver.take(frame_)) {
    }
  };
  const auto stamp_us = [&] {
    return std::chrono::duration_cast<std::chrono::microseconds>(device_.clock.time_since_epoch()).count();
  };
  turn();
  ASSERT_TRUE(device_.fill({.stamp_us = stamp_us()}));
  turn();
  ASSERT_EQ(driver.state().connection, Connection::running);
  for (int i = 1; i <= 20; ++i) {
    device_.failing[VIDIOC_DQBUF] = ENODEV;
    device_.remove_node("video" + std::to_string((i - 1) % 3));
    for (int k = 0; k < 1 + 3 * i; ++k) turn();
    ASSERT_EQ(driver.state().connection, Connection::away);
    device_.failing.clear();
    device_.add_node("video" + std::to_string(i % 3), i % 2 == 0 ? "1-2" : "1-3", "1d6b", "0105", "A1");
    driver.wake(device_.clock);
    turn();
    turn();
    ASSERT_TRUE(device_.fill({.sequence = 0, .stamp_us = stamp_us()}));
    turn();
    ASSERT_EQ(driver.state().connection, Connection::running) << i;
    ASSERT_EQ(device_.open_descriptors(), 1);
    ASSERT_LE(device_.mapped(), 12U);
  }
  EXPECT_EQ(device_.opened_node, "video2");
  EXPECT_EQ(driver.state().reopenings(), 20U);
  EXPECT_EQ(driver.state().images, 21U);
}

}  // namespace
}  // namespace azimuth
