#include "tools/evaluate/health_report.hpp"

#include <gtest/gtest.h>

#include "tests/support/stamps.hpp"

namespace azimuth {
namespace {

/// A drive at 2 m/s from 0 to 20 s.
std::vector<DrivenBy> driven() {
  std::vector<DrivenBy> driven;
  for (int i = 0; i <= 20; ++i) driven.push_back({at_s(i), 2.0 * i});
  return driven;
}

TEST(HealthReport, AHealthHoldsUntilTheNextStep) {
  const std::vector<StepHealth> steps{
      {at_s(1.0), Health::starting, "nothing yet", true}, {at_s(3.0), Health::tracking, "", true},
      {at_s(8.0), Health::degraded, "vague", true},       {at_s(9.0), Health::degraded, "vaguer", true},
      {at_s(10.0), Health::lost, "gone", true},           {at_s(15.0), Health::tracking, "", true},
      {at_s(16.0), Health::lost, "gone again", true}};
  const HealthReport report = health_report(steps, driven());
  EXPECT_EQ(report.of(Health::starting).seconds, 3.0) << "from the first reading on";
  EXPECT_EQ(report.of(Health::tracking).seconds, 6.0);
  EXPECT_EQ(report.of(Health::degraded).seconds, 2.0);
  EXPECT_EQ(report.of(Health::lost).seconds, 9.0) << "to the last reading";
  EXPECT_EQ(report.of(Health::degraded).share, 0.1);
  EXPECT_EQ(report.of(Health::degraded).first_reason, "vague");
  EXPECT_EQ(report.of(Health::degraded).first_reason_at_s, 8.0);
  EXPECT_EQ(report.of(Health::lost).first_reason, "gone");
  EXPECT_EQ(report.times_lost, 2U);
  EXPECT_EQ(report.times_found, 1U);
}

TEST(HealthReport, CountsWhatWasDrivenBlind) {
  std::vector<StepHealth> steps;  // 2 Hz; no bearings before 2 s and from 10 to 14 s; the last step is at 18 s
  for (int i = 0; i <= 36; ++i) {
    const double t_s = 0.5 * i;
    steps.push_back({at_s(t_s), Health::tracking, "", t_s >= 2.0 && !(t_s > 10.0 && t_s < 14.0)});
  }
  const BlindReport blind = health_report(steps, driven()).blind;
  EXPECT_EQ(blind.gaps, 3U);
  EXPECT_DOUBLE_EQ(blind.driven_m, 2.0 * (2.0 + 4.0 + 2.0));
  EXPECT_DOUBLE_EQ(blind.path_m, 40.0);
  EXPECT_DOUBLE_EQ(blind.longest_s, 4.0);
}

TEST(HealthReport, TakesTheUsualIntervalForNoGap) {
  std::vector<StepHealth> steps;
  for (int i = 0; i <= 4; ++i) steps.push_back({at_s(5.0 * i), Health::tracking, "", true});
  const BlindReport blind = health_report(steps, driven()).blind;
  EXPECT_EQ(blind.gaps, 0U);
  EXPECT_EQ(blind.driven_m, 0.0);
  EXPECT_EQ(blind.longest_s, 5.0);
}

TEST(HealthReport, SaysNothingWithoutAStep) {
  const HealthReport report = health_report({}, driven());
  EXPECT_FALSE(std::isfinite(report.blind.longest_s));
  EXPECT_EQ(report.of(Health::starting).seconds, 0.0);
}

}  // namespace
}  // namespace azimuth
