#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/stamps.hpp"
#include "tools/evaluate/report.hpp"

namespace azimuth {
namespace {

/// The report of a run with ten images per second, one of which is late, and the given durations of a step.
Report paced(const std::string& estimator, const std::string& front_end, double step_us, double detect_us = 0.0) {
  ReplayRecord record;
  record.estimator = estimator;
  record.front_end = front_end;
  for (int i = 0; i < 20; ++i) {
    record.estimates.push_back({at_s(0.1 * i + (i > 10 ? 0.4 : 0.0)), {}, Eigen::Matrix3d::Identity(), {}});
    record.times.step_us.push_back(step_us);
    if (detect_us > 0.0) record.times.detect_us.push_back(detect_us);
  }
  return evaluate(record);
}

TEST(Pace, AStepSlowerThanImagesComeIsSaidWithItsKey) {
  EXPECT_EQ(
      why_too_slow(paced("smoother", "bearings", 250e3)),
      "a step took 250.0 ms on the average and images came every 100.0 ms: a daemon on this machine would leave "
      "images out; a smaller smoother.max_keyframes, or fewer smoother.members where bearings have no names, make "
      "a step quicker");
  EXPECT_NE(why_too_slow(paced("fastslam", "lamps", 101e3, 10e3)).find("fastslam.particles"), std::string::npos);
  EXPECT_NE(why_too_slow(paced("lamp_ekf", "lamps", 101e3, 10e3)).find("lamp_ekf.max_landmarks"), std::string::npos);
  EXPECT_NE(why_too_slow(paced("ekf", "bearings", 101e3)).find("ekf.max_landmarks"), std::string::npos);
}

TEST(Pace, WhereTheImageTakesMostTheFrontEndIsNamed) {
  EXPECT_NE(why_too_slow(paced("ekf", "sift", 150e3, 120e3)).find("sift.side_px"), std::string::npos);
  EXPECT_NE(why_too_slow(paced("ekf", "colour", 150e3, 120e3)).find("smaller images"), std::string::npos);
}

TEST(Pace, OneThatIsQuickEnoughSaysNothing) {
  EXPECT_EQ(why_too_slow(paced("smoother", "bearings", 99e3)), "");
  EXPECT_EQ(why_too_slow(Report{}), "") << "nothing was measured";
}

TEST(Pace, TheReportHasThePeriodAndTheMean) {
  const auto json = nlohmann::json::parse(to_json(paced("ekf", "bearings", 20.0)));
  EXPECT_DOUBLE_EQ(json["time_us"]["image_period"].get<double>(), 1e5);
  EXPECT_DOUBLE_EQ(json["time_us"]["step"]["mean"].get<double>(), 20.0);
}

}  // namespace
}  // namespace azimuth
