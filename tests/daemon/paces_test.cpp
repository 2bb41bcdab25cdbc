#include "daemon/pipeline/paces.hpp"

#include <gtest/gtest.h>

namespace azimuth {
namespace {

using namespace std::chrono_literals;

enum class Mood { good, bad };
using Pace = StatusPace<Mood>;

constexpr Pace::Clock::time_point kStart{};

TEST(StatusPace, TellsAtTheStartAndThenOnceASecond) {
  Pace pace;
  EXPECT_TRUE(pace.due(Mood::good, kStart)) << "whatever the clock says";
  EXPECT_FALSE(pace.due(Mood::good, kStart));
  EXPECT_FALSE(pace.due(Mood::good, kStart + 999ms));
  EXPECT_TRUE(pace.due(Mood::good, kStart + 1s));
  EXPECT_FALSE(pace.due(Mood::good, kStart + 1999ms));
  EXPECT_TRUE(pace.due(Mood::good, kStart + 10s));
  EXPECT_FALSE(pace.due(Mood::good, kStart + 10s + 999ms)) << "seconds missed are not made up for";
}

TEST(StatusPace, TellsAChangeAtOnceAndCountsTheSecondFromThere) {
  Pace pace;
  EXPECT_TRUE(pace.is_change(Mood::good)) << "none was told";
  pace.due(Mood::good, kStart);
  EXPECT_FALSE(pace.is_change(Mood::good));
  EXPECT_TRUE(pace.is_change(Mood::bad));
  EXPECT_TRUE(pace.due(Mood::bad, kStart + 400ms));
  EXPECT_FALSE(pace.is_change(Mood::bad));
  EXPECT_FALSE(pace.due(Mood::bad, kStart + 1s));
  EXPECT_TRUE(pace.due(Mood::bad, kStart + 1400ms));
  EXPECT_TRUE(pace.due(Mood::good, kStart + 1401ms)) << "back again is a change, too";
}

}  // namespace
}  // namespace azimuth
