// What people are told beside poses: what was expected of an image, what is kept, and how soon a status comes.

#include <gtest/gtest.h>

#include "daemon/publish/messages.hpp"
#include "daemon/publish/publisher.hpp"
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
  step.expected.bearings[0].rejected_in_row = 4;  // of landmark 2
  use(1, 0.001 + 0.2, step);
  use(9, 0.0, step);  // nothing was expected of it
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

}  // namespace
}  // namespace azimuth
