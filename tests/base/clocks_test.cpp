#include "base/clocks.hpp"

#include <gtest/gtest.h>

namespace azimuth {
namespace {

using namespace std::chrono_literals;

/// Fails once if the machine's clock is set during the test.
TEST(Clocks, WhatTheEpochIsAheadByLeadsFromTheOneToTheOther) {
  const auto epoch = epoch_minus_monotonic();
  const auto monotonic = std::chrono::steady_clock::now().time_since_epoch();
  const auto wall = std::chrono::system_clock::now().time_since_epoch();
  EXPECT_LT(std::chrono::abs(wall - (monotonic + epoch)), 1s);
}

TEST(Clocks, KernelTimesKeepEveryNanosecond) {
  EXPECT_EQ(from_timespec({.tv_sec = 1'700'000'000, .tv_nsec = 999'999'999}), 1'700'000'001s - 1ns);
  EXPECT_EQ(from_timespec({.tv_sec = -1, .tv_nsec = 1}), 1ns - 1s);
}

TEST(Clocks, NowIsBetweenTwoLooksAtTheLibrarysClock) {
  const auto before = std::chrono::steady_clock::now().time_since_epoch();
  const auto now = now_on(CLOCK_MONOTONIC);
  EXPECT_GE(now + 1us, before);
  EXPECT_LE(now, std::chrono::steady_clock::now().time_since_epoch());
}

TEST(Clocks, SecondsAndBack) {
  EXPECT_EQ(clock_duration(0.25), 250ms);
  EXPECT_EQ(in_seconds(1500ms), 1.5);
  EXPECT_EQ(in_seconds(clock_duration(-3.0)), -3.0);
}

}  // namespace
}  // namespace azimuth
