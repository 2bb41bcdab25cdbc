#include "base/clocks.hpp"

#include <gtest/gtest.h>

namespace azimuth {
namespace {

using namespace std::chrono_literals;

/// A machine whose clock is set meanwhile fails here, once.
TEST(Clocks, WhatTheEpochIsAheadByLeadsFromTheOneToTheOther) {
  const auto epoch = epoch_minus_monotonic();
  const auto monotonic = std::chrono::steady_clock::now().time_since_epoch();
  const auto wall = std::chrono::system_clock::now().time_since_epoch();
  EXPECT_LT(std::chrono::abs(wall - (monotonic + epoch)), 1s);
}

}  // namespace
}  // namespace azimuth
