// Messages beside poses: the expectations of an image, the saved files, health, and the pace of the status.

#include <azimuth/pose_cov_t.hpp>
#include <gtest/gtest.h>

#include "daemon/publish/messages.hpp"
#include "daemon/publish/publisher.hpp"
#include "daemon/publish/status.hpp"
#include "tests/daemon/quiet.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

StepResult a_step(std::int64_t landmarks) {
  StepResult step;
  step.estimate.stamp = stamp_from_us(5'000'000);
  step.estimate.step = 7;
  step.expected.stamp = step.estimate.stamp;
  for (std::int64_t i = landmarks; i-- > 0;)
    step.expected.bearings.push_back({.landmark = i, .azimuth_rad = 0.001 * static_cast<double>(i), .sigma_rad = 0.1});
  return step;
}

void use(std::int64_t landmark, double azimuth_rad, StepResult& step) {
  step.estimate.accepted.push_back({.landmark_id = landmark, .azimuth_rad = azimuth_rad, .sigma_rad = 0.1});
}

TEST(ExpectationsMessage, SaysWhatWasExpectedAndHowFarOffItWas) {
  StepResult step = a_step(3);
  step.expected.bearings[0].rejected_in_row = 4;  // landmark 2, because the bearings are in descending order
  use(1, 0.001 + 0.2, step);
  use(9, 0.0, step);  // a landmark without an expectation
  expectations_t message;
  fill_message(step, message);
  EXPECT_EQ(message.utime, 5'000'000);
  EXPECT_EQ(message.step, 7);
  EXPECT_NEAR(message.nis, 4.0, 1e-12) << "two standard deviations, squared";
  EXPECT_EQ(message.compared, 1);
  ASSERT_EQ(message.n, 3);
  EXPECT_EQ(message.expected[2].landmark_id, 2);
  EXPECT_EQ(message.expected[2].rejected_in_row, 4);
}

TEST(ExpectationsMessage, OfALargeMapHasWhatWasUsed) {
  StepResult step = a_step(3000);
  use(2999, 2.999, step);
  expectations_t message;
  fill_message(step, message);
  ASSERT_EQ(message.n, expectations_t::MAX_EXPECTED);
  EXPECT_EQ(message.expected[0].landmark_id, 2999);
  EXPECT_EQ(message.compared, 1);
}

TEST(KeptMessage, SaysHowMuchOfTheQuotaIsUsed) {
  Status status;
  EXPECT_EQ(kept_message(status).log_size, -1) << "there is no log";
  status.record = {.text = "log/000.lcm", .kept_bytes = 1234, .quota_bytes = 8'000'000'000, .free_mb = 7};
  status.map.written_us = 55;
  const kept_t message = kept_message(status);
  EXPECT_EQ(message.log_size, 1234);
  EXPECT_EQ(message.log_quota, 8'000'000'000);
  EXPECT_EQ(message.disk_free, 7'000'000);
  EXPECT_EQ(message.map_utime, 55);
}

TEST(Publisher, AStatusOfWhichThereIsNewsComesSoonButNotAtEveryTurn) {
  Publisher publisher(quiet());
  Status status;
  const Publisher::Clock::time_point begin(1h);
  EXPECT_FALSE(publisher.send_due(begin, status));
  publisher.hasten_status();
  EXPECT_TRUE(publisher.send_due(begin + 1ms, status));
  publisher.hasten_status();
  EXPECT_FALSE(publisher.send_due(begin + 100ms, status)) << "one has just been sent";
  EXPECT_TRUE(publisher.send_due(begin + 210ms, status));
  EXPECT_FALSE(publisher.send_due(begin + 900ms, status));
  EXPECT_TRUE(publisher.send_due(begin + 1220ms, status)) << "then once a second as before";
}

status_t slow_message(const std::string& pace) {
  Status status;
  status.pace = pace;
  return status_message(status);
}

TEST(PaceWatch, TellsWhatComesFasterThanItIsWorkedOff) {
  PaceWatch watch;
  Status status;
  PaceWatch::Clock::time_point now(1h);
  const auto pass = [&](std::uint64_t looked, std::uint64_t replaced) {
    for (int second = 0; second < 5; ++second) {
      now += 1s;
      status.perception.frames += looked / 5;
      status.wires.frames_replaced += replaced / 5;
      watch.look(now, status);
    }
    return watch.text();
  };
  status.perception.detect_mean_us = 71'000.0;
  watch.look(now, status);
  EXPECT_EQ(pass(150, 0), "");
  EXPECT_EQ(pass(150, 10), "") << "some images wait for a moment on any machine";
  EXPECT_EQ(pass(60, 90),
            "images come every 33 ms and are worked off every 83 ms, of which finding bearings takes 71 ms: 60 % are "
            "left out; ask the camera for fewer or smaller ones (rate_hz), or give the estimator less to do");
  EXPECT_EQ(slow_message(watch.text()).input_trouble, watch.text());
  EXPECT_EQ(pass(150, 0), "");
}

TEST(PaceWatch, TellsOfBearingsLikewise) {
  PaceWatch watch;
  Status status;
  const PaceWatch::Clock::time_point begin(1h);
  watch.look(begin, status);
  status.estimate.step = 50;
  status.wires.bearings_refused = 50;
  watch.look(begin + 5s, status);
  EXPECT_EQ(watch.text(),
            "bearings come every 50 ms and a step takes 100 ms: 50 % are left out; send fewer, or give the estimator "
            "less to do (docs/tuning.md)");
}

/// The published health for an estimate with the estimator's own health `health`.
ToldHealth told(const DeviceStatus& odometer, const DeviceStatus& camera, Health health = Health::tracking) {
  Estimate estimate;
  estimate.health = health;
  estimate.reason = health == Health::tracking ? "" : "its own";
  return told_health(estimate, odometer, camera);
}

TEST(ToldHealth, IsNoBetterThanWhatFeedsIt) {
  const DeviceStatus works{.text = "running", .works = true}, none, gone{.text = "away", .away = 1s},
      long_gone{.text = "away", .away = 25s};
  EXPECT_EQ(told(works, works).health, Health::tracking);
  EXPECT_EQ(told(none, none).health, Health::tracking) << "a recording has no devices";
  EXPECT_EQ(told(gone, works).health, Health::degraded);
  EXPECT_EQ(told(gone, works).reason, "no odometry");
  EXPECT_EQ(told(long_gone, works).health, Health::lost);
  EXPECT_EQ(told(long_gone, gone).reason, "no odometry");
  EXPECT_EQ(told(works, long_gone).health, Health::degraded) << "what is known grows worse as the robot drives";
  EXPECT_EQ(told(works, gone).reason, "no images");
  EXPECT_EQ(told(gone, gone, Health::lost).reason, "its own");
  EXPECT_EQ(told(long_gone, works, Health::starting).health, Health::starting);
}

TEST(ToldHealth, IsThatOfTheStatusMessageAndOfTheLine) {
  Status status;
  status.any_estimate = true;
  status.estimate.health = Health::tracking;
  status.odometer = {.text = "silent: tcp:10.0.0.5:8101: no odometry", .away = 700ms};
  EXPECT_EQ(status_message(status).health, pose_cov_t::HEALTH_DEGRADED);
  EXPECT_EQ(status_message(status).reason, "no odometry");
  EXPECT_NE(status_line(status, 9s).find("degraded: no odometry"), std::string::npos);
}

}  // namespace
}  // namespace azimuth
