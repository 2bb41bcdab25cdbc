// Nothing allocates on the source's and the estimator's threads once storage has grown; and the counter that says so
// bites.

#include <chrono>
#include <gtest/gtest.h>
#include <vector>

#include "daemon/pipeline/pipeline.hpp"
#include "tests/daemon/allocation_counter.hpp"
#include "tests/daemon/fake_estimator.hpp"
#include "tests/daemon/small_run.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

constexpr double kRun_s = 600.0;
constexpr int kSettledAfter = 800, kWatchedUntil = 2200;  // of the run's 2400 bearing sets

/// Plays a run and counts what its middle part allocates; `in_update` runs on the estimator's thread at each set.
std::uint64_t allocations_in_steady_state(const std::function<void()>& in_update) {
  int updates = 0;
  const auto on_update = [&](const BearingSet&) {
    ++updates;
    if (updates == kSettledAfter) test::arm_allocation_counter();
    if (updates == kWatchedUntil) test::disarm_allocation_counter();
    in_update();
  };
  PublishSettings quiet;
  quiet.lcm_url = "memq://";
  Doorbell bell;
  Pipeline pipeline({.sources = test::played(test::small_recording(kRun_s), 0.0),
                     .estimator = EstimatorStage(std::make_unique<test::FakeEstimator>(on_update), Rig{}, {}),
                     .publisher = Publisher(quiet)},
                    ThreadSettings{}, bell);
  test::reset_allocation_counter();
  pipeline.start();
  for (int i = 0; i < 600 && !pipeline.finished(); ++i) bell.wait(100ms);
  pipeline.stop();
  EXPECT_GE(updates, kWatchedUntil);
  return test::counted_allocations();
}

TEST(Allocation, NoneOnSourceAndEstimatorThreadsInTheSteadyState) {
  if (!test::can_count_allocations()) GTEST_SKIP() << "the sanitizer brings its own heap";
  EXPECT_EQ(allocations_in_steady_state([] {}), 0U);
}

TEST(Allocation, TheCounterBites) {
  if (!test::can_count_allocations()) GTEST_SKIP() << "the sanitizer brings its own heap";
  const std::uint64_t allocations = allocations_in_steady_state([] {
    const std::vector<int> careless(100);
    asm volatile("" : : "r"(careless.data()) : "memory");  // or the compiler leaves it out
  });
  EXPECT_EQ(allocations, static_cast<std::uint64_t>(kWatchedUntil - kSettledAfter));
}

}  // namespace
}  // namespace azimuth
