// Frames through the threads: no frame waits in a queue, every lease is returned, and the bearings of each processed
// frame reach the estimator.

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <gtest/gtest.h>
#include <thread>

#include "daemon/pipeline/pipeline.hpp"
#include "drivers/storage/frame_reader.hpp"
#include "drivers/storage/run.hpp"
#include "tests/daemon/fake_estimator.hpp"
#include "tests/daemon/fake_perception.hpp"
#include "tests/daemon/quiet.hpp"
#include "tests/daemon/small_frames.hpp"
#include "tests/daemon/small_run.hpp"
#include "tests/support/temporary_folder.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using test::kSmallFrame;
using test::SmallPool;

/// A live camera and odometer in one. It takes an image in each turn, whether or not the pipeline keeps up.
class LiveCamera final : public Source {
 public:
  struct Counts {
    std::atomic<std::uint64_t> made{0}, without_buffer{0};
    std::atomic<int> most_leased{0};
  };

  LiveCamera(std::shared_ptr<SmallPool> pool, std::uint64_t images, std::chrono::microseconds interval, Counts& counts)
      : pool_(std::move(pool)), images_(images), interval_(interval), counts_(counts) {}

  const char* name() const override { return "camera"; }
  void restore(const OdometerMemory& /*memory*/) override {}

  bool turn(Doorbell& bell, SourceWires& wires) override {
    EXPECT_EQ(wires.bearings, nullptr) << "bearings are found in the frames";
    if (taken_ == images_) {
      bell.wait(10ms);
      return false;
    }
    std::this_thread::sleep_for(interval_);
    const Stamp stamp = stamp_from_us(1000 * static_cast<std::int64_t>(taken_ + 1));
    OdometryReading reading{.stamp = stamp, .sequence = taken_, .T_odom_body = {}};
    wires.odometry.push(reading);
    send(stamp, wires);
    counts_.most_leased = std::max(counts_.most_leased.load(), pool_->leased());
    ++taken_;
    return true;
  }

 private:
  void send(Stamp stamp, SourceWires& wires) {
    std::optional<Frame> frame = pool_->make(stamp, taken_, 3, 100);
    if (!frame) {
      ++counts_.without_buffer;
      return;
    }
    ++counts_.made;
    wires.frames->publish(*frame);
  }

  std::shared_ptr<SmallPool> pool_;
  std::uint64_t images_, taken_ = 0;
  std::chrono::microseconds interval_;
  Counts& counts_;
};

/// Counts of what the estimator received, written on its thread.
struct Given {
  std::atomic<std::uint64_t> sets{0}, bearings{0};
  std::atomic<bool> in_order{true};
  Stamp last{};
};

class FramesPipeline : public ::testing::Test {
 protected:
  Stages stages(std::uint64_t images, std::chrono::microseconds interval, test::FakePerception::OnImage on_image = {}) {
    const auto on_update = [this](const BearingSet& set) {
      given_.in_order = given_.in_order && set.stamp > given_.last;
      given_.last = set.stamp;
      given_.bearings += set.bearings.size();
      ++given_.sets;
    };
    std::vector<std::unique_ptr<Source>> sources;
    sources.push_back(std::make_unique<LiveCamera>(pool_, images, interval, counts_));
    return {
        .sources = std::move(sources),
        .perception = PerceptionStage(std::make_unique<test::FakePerception>(std::move(on_image)), PixelFormat::gray8),
        .estimator = EstimatorStage(std::make_unique<test::FakeEstimator>(on_update), Rig{}, StageSettings{}),
        .publisher = Publisher(quiet())};
  }
  void run_to_the_end(Pipeline& pipeline) {
    pipeline.start();
    for (int i = 0; i < 600 && !pipeline.finished(); ++i) bell_.wait(100ms);
    pipeline.stop();
  }

  Doorbell bell_;
  LiveCamera::Counts counts_;
  Given given_;
  std::shared_ptr<SmallPool> pool_ = std::make_shared<SmallPool>();
};

TEST_F(FramesPipeline, WhatIsLookedAtReachesTheEstimator) {
  constexpr std::uint64_t kImages = 300;
  Pipeline pipeline(stages(kImages, 200us), ThreadSettings{}, bell_);
  run_to_the_end(pipeline);
  const std::uint64_t replaced = pipeline.losses().frames_replaced;
  EXPECT_EQ(counts_.made, kImages);
  EXPECT_EQ(given_.sets + replaced, kImages) << "made = looked at + replaced";
  EXPECT_EQ(given_.bearings, 3 * given_.sets);
  EXPECT_TRUE(given_.in_order);
  EXPECT_EQ(pipeline.losses().bearings_refused, 0U);
  Status status;
  ASSERT_TRUE(pipeline.take_status(status));
  EXPECT_EQ(status.wires.frames_replaced, replaced);
  EXPECT_EQ(status.perception.frames, given_.sets) << "to the last one";
  EXPECT_EQ(status.estimate.step, given_.sets);
  EXPECT_EQ(pool_->leased(), 0);
}

TEST_F(FramesPipeline, WhatIsLookedAtIsRecordedAsTheCameraSentIt) {
  const test::TemporaryFolder folder;
  RecordSettings record;
  record.folder = folder.path();
  record.min_free_mb = 0.0;
  record.frames = RecordedFrames::raw;
  Stages recorded = stages(150, 2ms);
  const EventTimes times = EventTimes::of_recording(Stamp{});
  recorded.recorder.emplace(record, std::vector<Document>{{"rig.toml", test::kSmallRig}}, times);
  recorded.frame_recorder.emplace(record, times);
  std::uint64_t refused = 0;
  {
    Pipeline pipeline(std::move(recorded), ThreadSettings{}, bell_);
    run_to_the_end(pipeline);
    refused = pipeline.losses().records_refused;
  }
  EXPECT_EQ(pool_->leased(), 0);

  FileResult<azimuth::Run> run = load_run(std::filesystem::directory_iterator(folder.path())->path());
  ASSERT_TRUE(run) << text(run.error());
  EXPECT_EQ(run->frames.size() + refused, given_.sets) << "made = recorded + counted";
  EXPECT_GE(run->frames.size(), 8U);
  FrameReader images(run->folder);
  BearingSet seen;
  for (const FrameFile& frame : run->frames) {
    test::FakePerception().observe(images.read(frame), seen);
    const auto of_then = std::ranges::find(run->bearings, frame.stamp, &BearingSet::stamp);
    ASSERT_NE(of_then, run->bearings.end());
    ASSERT_EQ(seen.bearings.size(), of_then->bearings.size());
    for (std::size_t i = 0; i < seen.bearings.size(); ++i)
      EXPECT_EQ(seen.bearings[i].azimuth_rad, of_then->bearings[i].azimuth_rad);
  }
}

TEST_F(FramesPipeline, ImagesThatNoDiskTakesAreLostAndNothingElse) {
  RecordSettings record;
  record.folder = "/dev/null/recordings";
  record.frames = RecordedFrames::raw;
  Stages recorded = stages(50, 1ms);
  const EventTimes times = EventTimes::of_recording(Stamp{});
  recorded.recorder.emplace(record, std::vector<Document>{}, times);
  recorded.frame_recorder.emplace(record, times);
  Pipeline pipeline(std::move(recorded), ThreadSettings{}, bell_);
  run_to_the_end(pipeline);
  EXPECT_EQ(given_.sets + pipeline.losses().frames_replaced, 50U);
  EXPECT_EQ(pool_->leased(), 0);
}

TEST_F(FramesPipeline, SlowPerceptionSeesTheNewestAndHoldsTwoBuffersAtMost) {
  constexpr std::uint64_t kImages = 400;
  Pipeline pipeline(stages(kImages, 100us, [](const ImageView&) { std::this_thread::sleep_for(3ms); }),
                    ThreadSettings{}, bell_);
  run_to_the_end(pipeline);
  EXPECT_EQ(counts_.without_buffer, 0U);
  EXPECT_LE(counts_.most_leased, 3) << "the one looked at, the one waiting, the one just taken";
  EXPECT_EQ(given_.sets + pipeline.losses().frames_replaced, kImages);
  EXPECT_GT(pipeline.losses().frames_replaced, kImages / 2);
  EXPECT_EQ(given_.last, stamp_from_us(1000 * static_cast<std::int64_t>(kImages))) << "the last one is the newest";
}

TEST_F(FramesPipeline, SlowEstimatorCostsFramesNotBearings) {
  constexpr std::uint64_t kImages = 2000;
  Stages slow = stages(kImages, 20us);
  slow.estimator = EstimatorStage(std::make_unique<test::FakeEstimator>([this](const BearingSet&) {
                                    ++given_.sets;
                                    std::this_thread::sleep_for(1ms);
                                  }),
                                  Rig{}, StageSettings{});
  Pipeline pipeline(std::move(slow), ThreadSettings{}, bell_);
  run_to_the_end(pipeline);
  EXPECT_EQ(pipeline.losses().bearings_refused, 0U);
  EXPECT_GT(pipeline.losses().frames_replaced, 0U);
}

TEST_F(FramesPipeline, LeasesComeBackWheneverItStops) {
  for (int round = 0; round < 30; ++round) {
    {
      Pipeline pipeline(stages(1'000'000, 50us, [](const ImageView&) { std::this_thread::sleep_for(400us); }),
                        ThreadSettings{}, bell_);
      pipeline.start();
      std::this_thread::sleep_for(std::chrono::microseconds(311 * round));
      if (round % 2 == 0) pipeline.stop();
    }
    EXPECT_EQ(pool_->leased(), 0) << round;
    given_.last = {};
  }
}

TEST_F(FramesPipeline, NamesAPerceptionThatHangs) {
  std::atomic<bool> hang{true};
  ThreadSettings threads;
  threads.deadline_ms = 200;
  Pipeline pipeline(stages(5, 1ms,
                           [&](const ImageView&) {
                             while (hang) std::this_thread::sleep_for(1ms);
                           }),
                    threads, bell_);
  pipeline.start();
  std::this_thread::sleep_for(500ms);
  const StageThread* const late = pipeline.first_late(std::chrono::steady_clock::now());
  ASSERT_NE(late, nullptr);
  EXPECT_STREQ(late->spec().name, "perception");
  hang = false;
}

}  // namespace
}  // namespace azimuth
