#pragma once
// A stream of a simulated camera.

#include <gtest/gtest.h>
#include <poll.h>

#include "drivers/v4l2/v4l2_stream.hpp"
#include "tests/drivers/v4l2/fake_v4l2.hpp"

namespace azimuth::test {

class V4l2StreamTest : public testing::Test {
 protected:
  void open(const V4l2Settings& settings = {.buffers = 4}) {
    opened_ = OpenedStream{};
    opened_ = open_v4l2(settings, device_);
    ASSERT_TRUE(opened_) << opened_.error().text;
  }
  ImageStream& stream() { return **opened_; }
  ImageStream::Read read() { return stream().read(frame_); }
  bool is_readable() {
    pollfd ready{.fd = stream().descriptor(), .events = stream().poll_events(), .revents = 0};
    return ::poll(&ready, 1, 0) == 1;
  }

  FakeV4l2 device_;  // must outlive the frames
  OpenedStream opened_;
  Frame frame_;
};

}  // namespace azimuth::test
