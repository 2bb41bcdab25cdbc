// The odometer's memory from one process to the next, for a base on a CAN bus.

#include <gtest/gtest.h>
#include <limits>
#include <memory>

#include "drivers/can/can_odometer.hpp"
#include "tests/drivers/can/can_odometer_bench.hpp"
#include "tests/drivers/can/fake_base.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using test::drive_a_course;
using test::FakeBase;
using test::OdometerBench;

/// The process after that of `before`. It assumes the same base.
std::unique_ptr<OdometerBench> next_process(const OdometerBench& before, const CanLayout& layout) {
  auto next = std::make_unique<OdometerBench>(layout);
  OdometerMemory memory;
  EXPECT_TRUE(before.odometer.remember(memory));
  if (!next->odometer.restore(memory)) next->odometer.follow(memory.origin);
  next->base = before.base;
  next->now = before.now;
  return next;
}

TEST(CanOdometerMemory, LetsTheNextProcessGoOnAndLosesNoMotion) {
  for (const auto& layout : {test::ticks_layout(), test::ticks_layout(test::kLeftId), test::pose_layout()}) {
    OdometerBench bench(layout);
    drive_a_course(bench);
    const auto next = next_process(bench, layout);
    for (int i = 0; i < 100; ++i) next->go(0.4, 0.5);  // no process listens
    next->run(0.4, 0.5, 1s);
    ASSERT_FALSE(next->readings.empty());
    EXPECT_EQ(next->readings.front().origin, bench.readings.back().origin);
    EXPECT_EQ(next->odometer.restarts(), 0U);
    EXPECT_GT(next->readings.front().sigma_gap_m, 0.0) << "nobody knows the way it took";
    EXPECT_EQ(next->readings.back().sigma_gap_m, 0.0);
    EXPECT_LT(next->distance_from_truth_m(), 0.1 + bench.distance_from_truth_m());
    EXPECT_EQ(next->odometer.missed(), 0U) << "what was sent to nobody is not missing";
  }
}

TEST(CanOdometerMemory, IsNotBelievedWhenTheBaseBeganAnew) {
  OdometerBench bench(test::ticks_layout());
  drive_a_course(bench);
  const auto next = next_process(bench, test::ticks_layout());
  next->base = FakeBase();
  next->go(0.0, 0.0, 2s);
  next->run(0.2, 0.2, 1s);
  ASSERT_FALSE(next->readings.empty());
  EXPECT_EQ(next->readings.front().origin, bench.readings.back().origin + 1);
}

TEST(CanOdometerMemory, IsOfNoUseForOtherSignals) {
  OdometerBench bench(test::ticks_layout());
  drive_a_course(bench);
  const auto next = next_process(bench, test::pose_layout());
  next->run(0.2, 0.2, 1s);
  ASSERT_FALSE(next->readings.empty());
  EXPECT_EQ(next->readings.front().origin, bench.readings.back().origin + 1);
  EXPECT_EQ(next->odometer.restarts(), 0U);
}

TEST(CanOdometerMemory, IsNotBelievedWithNumbersThatAreNone) {
  OdometerBench bench(test::ticks_layout());
  drive_a_course(bench);
  OdometerMemory memory;
  ASSERT_TRUE(bench.odometer.remember(memory));
  for (const std::size_t number : {1U, 2U, 3U, 5U, 12U, 13U}) {
    OdometerMemory bad = memory;
    bad.put(number, std::numeric_limits<double>::quiet_NaN());
    EXPECT_FALSE(bench.odometer.restore(bad)) << number;
  }
}

TEST(CanOdometerMemory, IsNoneOfSpeeds) {
  OdometerBench bench(test::speeds_layout());
  bench.run(0.3, 0.3, 1s);
  OdometerMemory memory;
  EXPECT_FALSE(bench.odometer.remember(memory)) << "nobody sums them up meanwhile";
}

}  // namespace
}  // namespace azimuth
