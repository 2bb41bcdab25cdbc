#include <gtest/gtest.h>

#include "tests/tools/compare/made_reports.hpp"
#include "tools/compare/comparison.hpp"

namespace azimuth {
namespace {

using test::figure;
using test::made_report;

TEST(Limits, AreThoseOfTheFileOverTheDefaults) {
  const FileResult<CompareSettings> read = read_limits(
      "chance_of_false_alarm = 0.01\n[reports]\nmissing = 2\n[anees]\ngood_enough = 2.0\n[step_median_us]\n"
      "relative = 0.5\nmean = 0.1\n[position_rmse_m]\nworst = 0.5\n",
      "limits.toml");
  ASSERT_TRUE(read) << text(read.error());
  EXPECT_EQ(read->chance_of_false_alarm, 0.01);
  EXPECT_EQ(read->missing, 2u);
  EXPECT_EQ(read->failed, 0u);
  EXPECT_EQ(read->limits[figure("anees")].good_enough, 2.0);
  EXPECT_EQ(read->limits[figure("anees")].relative, 0.2);
  EXPECT_EQ(read->limits[figure("step_median_us")].relative, 0.5);
  EXPECT_EQ(read->limits[figure("position_rmse_m")].worst, 0.5);
}

TEST(Limits, NameEveryMistake) {
  const FileResult<CompareSettings> read =
      read_limits("[position_rmse]\nrelative = 0.1\n[anees]\nrelativ = 1\nabsolute = -1\n", "limits.toml");
  ASSERT_FALSE(read);
  const std::string all = text(read.error());
  for (const char* part : {"limits.toml:1:2: unknown section [position_rmse]; did you mean [position_rmse_m]?",
                           "limits.toml:4:1: unknown key 'relativ'", "limits.toml:5:1: 'anees.absolute' is -1"})
    EXPECT_NE(all.find(part), std::string::npos) << part << "\nis not in\n" << all;
}

Reports one(std::string_view key, double value) { return {{made_report("monday", {{key, value}})}, {}}; }

TEST(Limits, OfTimesJudgeTimes) {
  const CompareSettings settings = *read_limits("[step_median_us]\nrelative = 0.5\n", "limits.toml");
  const Reports now = one("step_median_us", 160), then = one("step_median_us", 100);
  const std::vector<std::string> past = past_limits(compare(now, &then, settings), settings);
  ASSERT_EQ(past.size(), 1u);
  EXPECT_EQ(past[0], "monday: step median 160 us, was 100 us: worse by 60.0 %");
}

TEST(Limits, WithoutABaselineTheWorstIsJudgedStill) {
  const CompareSettings settings =
      *read_limits("[position_rmse_m]\nworst = 0.5\n[tracking_share]\nworst = 0.9\n", "limits.toml");
  const auto past = [&](std::string_view key, double value) {
    return past_limits(compare(one(key, value), nullptr, settings), settings);
  };
  EXPECT_TRUE(past("position_rmse_m", 0.49).empty());
  EXPECT_TRUE(past("tracking_share", 0.95).empty());
  ASSERT_EQ(past("position_rmse_m", 0.51).size(), 1u);
  EXPECT_EQ(past("tracking_share", 0.85)[0], "monday: tracking 85.0 % is worse than 90.0 %");
}

}  // namespace
}  // namespace azimuth
