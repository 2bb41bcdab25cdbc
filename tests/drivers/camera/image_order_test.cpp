#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <set>
#include <vector>

#include "drivers/camera/camera_driver.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using Clock = ImageOrder::Clock;

constexpr Clock::time_point at(std::int64_t us) { return Clock::time_point{std::chrono::microseconds(us)}; }

/// Judges an image that arrives 5 ms after its stamp.
ImageOrder::Verdict usual(ImageOrder& order, std::uint64_t sequence, std::int64_t stamp_us) {
  return order.judge(sequence, stamp_from_us(stamp_us), at(stamp_us + 5'000));
}

TEST(ImageOrder, AGoodImageIsHandedOnAsItIs) {
  ImageOrder order;
  const auto verdict = usual(order, 17, 10'000'000);
  EXPECT_TRUE(verdict.usable);
  EXPECT_FALSE(verdict.replaced);
  EXPECT_EQ(verdict.stamp, stamp_from_us(10'000'000));
  EXPECT_EQ(verdict.missing, 0U) << "what was before a stream's first image nobody knows";
}

TEST(ImageOrder, CountsGapsExactlyAndLeavesThemVisible) {
  ImageOrder order;
  const std::uint64_t first = usual(order, 100, 10'000'000).sequence;
  EXPECT_EQ(usual(order, 101, 10'100'000).missing, 0U);
  const auto verdict = usual(order, 105, 10'500'000);
  EXPECT_EQ(verdict.missing, 3U);
  EXPECT_EQ(verdict.sequence, first + 5);
}

TEST(ImageOrder, ACorruptImageIsNotMissing) {
  ImageOrder order;
  usual(order, 1, 10'000'000);
  order.corrupt();
  order.corrupt();
  EXPECT_EQ(usual(order, 5, 10'400'000).missing, 1U) << "of 2, 3 and 4 two were corrupt";
  order.corrupt();
  EXPECT_EQ(usual(order, 6, 10'500'000).missing, 0U) << "a device that does not number corrupt ones";
  EXPECT_EQ(usual(order, 8, 10'700'000).missing, 1U) << "and they are forgotten then";
}

TEST(ImageOrder, SequenceAscendsOverStreamsWithAGapOfOne) {
  ImageOrder order;
  usual(order, 1000, 10'000'000);
  const std::uint64_t before = usual(order, 1001, 10'100'000).sequence;
  order.begin_stream();
  const auto verdict = usual(order, 0, 11'000'000);
  EXPECT_EQ(verdict.sequence, before + 2);
  EXPECT_EQ(verdict.missing, 0U);
  EXPECT_FALSE(verdict.restarted);
}

TEST(ImageOrder, SequenceThatStandsStillIsCountedOn) {
  ImageOrder order;
  const std::uint64_t first = usual(order, 0, 10'000'000).sequence;
  const auto second = usual(order, 0, 10'100'000);
  EXPECT_TRUE(second.restarted);
  EXPECT_EQ(second.sequence, first + 1);
  EXPECT_EQ(second.missing, 0U);
  EXPECT_TRUE(second.usable);
}

TEST(ImageOrder, AStampOfTheFutureIsReplacedByTheArrival) {
  ImageOrder order;
  const auto verdict = order.judge(0, stamp_from_us(20'000'000), at(10'000'000));
  EXPECT_TRUE(verdict.usable);
  EXPECT_TRUE(verdict.replaced);
  EXPECT_EQ(verdict.stamp, stamp_from_us(10'000'000));
  EXPECT_TRUE(usual(order, 1, 10'050'000).usable);
}

TEST(ImageOrder, AStampThatGoesBackwardsOrStandsStillDropsTheImage) {
  ImageOrder order;
  usual(order, 0, 10'000'000);
  EXPECT_FALSE(order.judge(1, stamp_from_us(9'990'000), at(10'100'000)).usable);
  EXPECT_FALSE(order.judge(2, stamp_from_us(10'000'000), at(10'200'000)).usable);
  const auto verdict = usual(order, 3, 10'300'000);
  EXPECT_TRUE(verdict.usable);
  EXPECT_EQ(verdict.missing, 0U) << "dropped ones were there";
}

TEST(ImageOrder, ImagesThatWaitedWhileTheProcessStoodStillAreDropped) {
  ImageOrder order;
  usual(order, 0, 10'000'000);
  for (std::uint64_t i = 1; i <= 4; ++i)
    EXPECT_FALSE(
        order.judge(i, stamp_from_us(10'000'000 + 100'000 * static_cast<std::int64_t>(i)), at(30'000'000)).usable);
  EXPECT_TRUE(usual(order, 5, 30'010'000).usable);
}

TEST(ImageOrder, ADeviceWithAnotherClockGetsTheTimeOfArrival) {
  ImageOrder order;
  int dropped = 0;
  std::int64_t now_us = 1'000'000'000;
  for (std::uint64_t i = 0; i < 100; ++i, now_us += 100'000) {
    const auto verdict = order.judge(i, stamp_from_us(static_cast<std::int64_t>(i) * 100'000), at(now_us));
    dropped += verdict.usable ? 0 : 1;
    if (verdict.usable) {
      EXPECT_TRUE(verdict.replaced);
      EXPECT_EQ(verdict.stamp, stamp_from_us(now_us));
    }
  }
  EXPECT_EQ(dropped, ImageOrder::kMostDropped);
}

RC_GTEST_PROP(ImageOrder, WhateverComesWhatIsHandedOnAscends, ()) {
  ImageOrder order;
  std::optional<ImageOrder::Verdict> before;
  std::int64_t now_us = 1'000'000'000;
  const int images = *rc::gen::inRange(1, 60);
  for (int i = 0; i < images; ++i) {
    now_us += *rc::gen::inRange<std::int64_t>(1, 200'000);
    if (*rc::gen::inRange(0, 10) == 0) order.begin_stream();
    if (*rc::gen::inRange(0, 10) == 0) order.corrupt();
    const auto sequence = *rc::gen::element<std::uint64_t>(*rc::gen::inRange<std::uint64_t>(0, 50),
                                                           *rc::gen::arbitrary<std::uint64_t>() >> 8U);
    const auto stamp_us = *rc::gen::element<std::int64_t>(now_us - *rc::gen::inRange<std::int64_t>(-300'000, 300'000),
                                                          *rc::gen::arbitrary<std::int64_t>() / 2);
    const auto verdict = order.judge(sequence, stamp_from_us(stamp_us), at(now_us));
    if (!verdict.usable) continue;
    RC_ASSERT(to_us(verdict.stamp) <= now_us);
    if (before) {
      RC_ASSERT(verdict.stamp > before->stamp);
      RC_ASSERT(verdict.sequence > before->sequence);
    }
    before = verdict;
  }
}

}  // namespace
}  // namespace azimuth
