#include <cerrno>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "drivers/device/back_off.hpp"
#include "drivers/device/connection.hpp"
#include "drivers/device/device_clock.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using Clock = BackOff::Clock;

constexpr Clock::time_point kStart{1000s};

TEST(Stamps, AreTheMicrosecondThatAnInstantLiesIn) {
  EXPECT_EQ(stamp_at(kStart + 1999ns), stamp_from_us(1'000'000'001));
  EXPECT_EQ(stamp_at(kStart + 1999ns, Duration(5)), stamp_from_us(1'000'000'006));
  EXPECT_EQ(instant_of(stamp_from_us(1'000'000'006), Duration(5)), kStart + 1us);
}

TEST(BackOff, FindsADeviceWithinATwentiethOfTheTimeItWasAway) {
  BackOff back_off(50ms, 1s);
  EXPECT_TRUE(back_off.is_due(kStart));
  for (Clock::time_point now = kStart; now < kStart + 60s; now = back_off.due()) {
    back_off.failed(now);
    const Clock::duration wait = back_off.due() - now;
    EXPECT_GE(wait, 50ms);
    EXPECT_LE(wait, std::clamp<Clock::duration>((now - kStart) / 20, 50ms, 1s));
    EXPECT_FALSE(back_off.is_due(back_off.due() - 1ns));
  }
}

TEST(BackOff, BeginsAnewOnceTheDeviceHasWorked) {
  BackOff back_off(50ms, 1s);
  back_off.failed(kStart);
  back_off.failed(kStart + 1h);
  EXPECT_EQ(back_off.due(), kStart + 1h + 1s);
  back_off.succeeded();
  back_off.failed(kStart + 2h);
  EXPECT_EQ(back_off.due(), kStart + 2h + 50ms);
}

TEST(BackOff, IsEagerForAWhileAfterAHint) {
  BackOff back_off(50ms, 1s);
  back_off.failed(kStart);
  const Clock::time_point hint = kStart + 1h;
  back_off.failed(hint - 1ms);
  back_off.wake(hint);
  EXPECT_TRUE(back_off.is_due(hint));
  back_off.failed(hint + 2900ms);
  EXPECT_EQ(back_off.due(), hint + 2950ms);
  back_off.failed(hint + 10s);
  EXPECT_EQ(back_off.due(), hint + 10500ms);
}

TEST(BackOff, CanBePostponedUntilAHint) {
  BackOff back_off(50ms, 1s);
  back_off.postpone(kStart + 20s);
  EXPECT_FALSE(back_off.is_due(kStart + 19s));
  back_off.wake(kStart + 5s);
  EXPECT_TRUE(back_off.is_due(kStart + 5s));
}

std::vector<std::string> told(DeviceNews& news) {
  std::vector<std::string> all;
  for (std::string event; news.take(event);) all.push_back(event);
  return all;
}

TEST(DeviceNews, TellsOfEachTroubleOnceUntilTheDeviceRuns) {
  DeviceNews news("odometry comes from can0");
  DeviceState state;
  news.enter(Connection::away, "can0: is down", state);
  news.enter(Connection::starting, "", state);
  EXPECT_EQ(state.trouble, "can0: is down") << "it goes on until something comes";
  news.enter(Connection::away, "can0: is down", state);
  EXPECT_EQ(told(news), (std::vector<std::string>{"can0: is down"}));
  news.enter(Connection::running, "", state);
  EXPECT_EQ(state.trouble, "");
  news.enter(Connection::running, "", state);
  news.enter(Connection::away, "can0: is down", state);
  EXPECT_EQ(told(news), (std::vector<std::string>{"odometry comes from can0", "can0: is down"}));
}

TEST(DeviceNews, TellsOfTroublesThatAlternateOnceEach) {
  DeviceNews news;
  DeviceState state;
  for (int i = 0; i < 50; ++i) {
    news.enter(Connection::away, "cannot be opened", state);
    news.enter(Connection::silent, "no image", state);
    EXPECT_EQ(state.trouble, "no image");
  }
  EXPECT_EQ(told(news), (std::vector<std::string>{"cannot be opened", "no image"}));
}

TEST(DeviceErrors, OfADeviceThatHangsAreNotThoseOfOneThatIsGone) {
  for (const int error : {EIO, ETIMEDOUT, EPROTO, EPIPE, EILSEQ}) {
    EXPECT_TRUE(is_hung(error));
    EXPECT_FALSE(is_absent(error));
  }
  for (const int error : {ENOENT, ENODEV, ENXIO}) {
    EXPECT_TRUE(is_absent(error));
    EXPECT_FALSE(is_hung(error));
  }
  EXPECT_FALSE(is_hung(EACCES) || is_absent(EACCES));
}

}  // namespace
}  // namespace azimuth
