// The threads of the source, the perception and the estimator do not allocate once their storage has grown. A further
// test proves that the counter detects allocations.

#include <array>
#include <chrono>
#include <gtest/gtest.h>
#include <vector>

#include "daemon/pipeline/pipeline.hpp"
#include "tests/daemon/allocation_counter.hpp"
#include "tests/daemon/fake_estimator.hpp"
#include "tests/daemon/fake_perception.hpp"
#include "tests/daemon/small_frames.hpp"
#include "tests/daemon/small_run.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

constexpr double kRun_s = 600.0;
constexpr int kSettledAfter = 800, kWatchedUntil = 2200;  // of the run's 2400 bearing sets

/// A pixel row with which FakePerception finds six bearings.
constexpr std::array<std::byte, 32> kImage{std::byte{6},   std::byte{20},  std::byte{60}, std::byte{100},
                                           std::byte{140}, std::byte{180}, std::byte{220}};

/// The source of the small run; with `with_images`, images replace its bearings.
std::vector<std::unique_ptr<Source>> source(bool with_images) {
  Recording recording = test::small_recording(kRun_s);
  if (!with_images) return test::played(std::move(recording), 0.0);
  for (const BearingSet& set : recording.bearings) recording.frames.push_back(set.stamp);
  recording.bearings.clear();
  std::vector<std::unique_ptr<Source>> sources;
  sources.push_back(std::make_unique<PlayedSource>(std::move(recording), 0.0, [](std::size_t) {
    return ImageView{test::kSmallFrame, kImage};
  }));
  return sources;
}

/// `on_image` runs on the perception thread for each image.
std::optional<PerceptionStage> perception(const test::FakePerception::OnImage& on_image = {}) {
  return std::optional<PerceptionStage>(std::in_place, std::make_unique<test::FakePerception>(on_image),
                                        PixelFormat::gray8);
}

/// Plays a run and counts the allocations in its middle part. `in_update` runs on the estimator thread for each set.
std::uint64_t allocations_in_steady_state(
    std::vector<std::unique_ptr<Source>> sources, std::optional<PerceptionStage> perceives,
    const std::function<void()>& in_update = [] {}) {
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
  Pipeline pipeline({.sources = std::move(sources),
                     .perception = std::move(perceives),
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

void allocate() {
  const std::vector<int> careless(100);
  asm volatile("" : : "r"(careless.data()) : "memory");  // keeps the compiler from removing the allocation
}

class Allocation : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!test::can_count_allocations()) GTEST_SKIP() << "the sanitizer brings its own heap";
  }
};

TEST_F(Allocation, NoneOnSourceAndEstimatorThreadsInTheSteadyState) {
  EXPECT_EQ(allocations_in_steady_state(source(false), std::nullopt), 0U);
}

TEST_F(Allocation, NoneWithImagesEither) { EXPECT_EQ(allocations_in_steady_state(source(true), perception()), 0U); }

TEST_F(Allocation, TheCounterBitesOnTheEstimatorsThread) {
  const std::uint64_t allocations = allocations_in_steady_state(source(false), std::nullopt, allocate);
  EXPECT_EQ(allocations, static_cast<std::uint64_t>(kWatchedUntil - kSettledAfter));
}

TEST_F(Allocation, TheCounterBitesOnThePerceptionsThread) {
  EXPECT_GT(allocations_in_steady_state(source(true), perception([](const ImageView&) { allocate(); })), 1000U);
}

}  // namespace
}  // namespace azimuth
