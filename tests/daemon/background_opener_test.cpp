#include <atomic>
#include <chrono>
#include <functional>
#include <gtest/gtest.h>

#include "daemon/devices/camera_source.hpp"
#include "tests/drivers/camera/fake_stream.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

bool comes_true(const std::function<bool()>& condition) {
  const auto limit = std::chrono::steady_clock::now() + 20s;
  while (std::chrono::steady_clock::now() < limit) {
    if (condition()) return true;
    std::this_thread::sleep_for(1ms);
  }
  return false;
}

OpenedStream wait_for(BackgroundOpener& opener) {
  OpenedStream opened;
  EXPECT_TRUE(comes_true([&] {
    opened = opener.open();
    return !opened || *opened;
  }));
  return opened;
}

TEST(BackgroundOpener, GivesTheStreamWhenItIsOpen) {
  test::FakeCameraDevice device;
  BackgroundOpener opener(device.opener());
  const OpenedStream opened = wait_for(opener);
  ASSERT_TRUE(opened && *opened);
  ImageStream& stream = **opened;
  EXPECT_EQ(stream.description().device, "/dev/omnicam");
  EXPECT_EQ(stream.descriptor(), test::FakeStream::kDescriptor);
  device.images.push_back({ImageStream::Read::image, 3, stamp_from_us(7)});
  Frame frame;
  EXPECT_EQ(stream.read(frame), ImageStream::Read::image);
  EXPECT_EQ(frame.sequence, 3U);
}

TEST(BackgroundOpener, GivesTheTroubleAndTriesAgainWhenAsked) {
  test::FakeCameraDevice device;
  device.opening = {"/dev/omnicam: no", 2};
  BackgroundOpener opener(device.opener());
  EXPECT_EQ(wait_for(opener).error().text, "/dev/omnicam: no");
  {
    const std::lock_guard lock(device.mutex);
    device.opening = {};
  }
  EXPECT_TRUE(wait_for(opener));
}

TEST(BackgroundOpener, DoesNotBlockWhileTheDeviceHangs) {
  test::FakeCameraDevice device;
  std::atomic<bool> hangs = true;
  std::atomic<int> asked = 0;
  BackgroundOpener opener([&] {
    ++asked;
    hangs.wait(true);
    return device.opener()();
  });
  for (int i = 0; i < 100; ++i) {
    const OpenedStream opened = opener.open();
    ASSERT_TRUE(opened);
    ASSERT_FALSE(*opened) << "still opening";
  }
  EXPECT_TRUE(comes_true([&] { return asked == 1; }));
  hangs = false;
  hangs.notify_all();
  EXPECT_TRUE(wait_for(opener));
  EXPECT_EQ(asked, 1);
}

TEST(BackgroundOpener, ClosesAStreamBeforeItOpensTheNext) {
  test::FakeCameraDevice device;
  int most_open = 0;
  BackgroundOpener opener([&] {
    OpenedStream opened = device.opener()();
    const std::lock_guard lock(device.mutex);
    most_open = std::max(most_open, device.open_now);
    return opened;
  });
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(wait_for(opener));
  const std::lock_guard lock(device.mutex);
  EXPECT_EQ(most_open, 1);
  EXPECT_EQ(device.opened, 50);
}

TEST(BackgroundOpener, StreamsMayOutliveItOrNeverBeFetched) {
  test::FakeCameraDevice device;
  {
    OpenedStream kept;
    {
      BackgroundOpener opener(device.opener());
      kept = wait_for(opener);
    }
    EXPECT_TRUE(kept && *kept);
  }
  EXPECT_EQ(device.open_now, 0);
  {
    BackgroundOpener opener(device.opener());
    opener.open();
    EXPECT_TRUE(comes_true([&] {
      const std::lock_guard lock(device.mutex);
      return device.opened == 2;
    }));
  }
  EXPECT_EQ(device.open_now, 0);
}

}  // namespace
}  // namespace azimuth
