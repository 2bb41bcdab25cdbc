#include "tools/evaluate/statistics.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <vector>

namespace azimuth {
namespace {

TEST(ErrorStatistics, OfHandMadeErrors) {
  const ErrorStatistics statistics = error_statistics(std::vector{3.0, 4.0, 0.0, 5.0});
  EXPECT_EQ(statistics.count, 4u);
  EXPECT_DOUBLE_EQ(statistics.mean, 3.0);
  EXPECT_DOUBLE_EQ(statistics.rmse, std::sqrt(50.0 / 4));
  EXPECT_DOUBLE_EQ(statistics.max, 5.0);
  EXPECT_DOUBLE_EQ(statistics.final, 5.0);
}

TEST(ErrorStatistics, OfNothingAreNotMeasured) {
  const ErrorStatistics statistics = error_statistics({});
  EXPECT_EQ(statistics.count, 0u);
  EXPECT_TRUE(std::isnan(statistics.rmse) && std::isnan(statistics.mean));
  EXPECT_TRUE(std::isnan(statistics.max) && std::isnan(statistics.final));
}

TEST(TimeStatistics, AreNearestRanks) {
  std::vector<double> durations_us(200);
  std::iota(durations_us.rbegin(), durations_us.rend(), 1.0);  // 200 ... 1
  const TimeStatistics statistics = time_statistics(durations_us);
  EXPECT_DOUBLE_EQ(statistics.median_us, 100.0);
  EXPECT_DOUBLE_EQ(statistics.p99_us, 198.0);
  EXPECT_DOUBLE_EQ(statistics.max_us, 200.0);
}

TEST(TimeStatistics, OfOneAndOfNone) {
  EXPECT_DOUBLE_EQ(time_statistics(std::vector{7.0}).p99_us, 7.0);
  EXPECT_TRUE(std::isnan(time_statistics({}).median_us));
}

}  // namespace
}  // namespace azimuth
