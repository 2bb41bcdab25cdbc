// All threads together: playing at any speed gives the result of a replay without threads, and start and stop may come
// at any time.

#include "daemon/pipeline/pipeline.hpp"

#include <gtest/gtest.h>
#include <set>
#include <thread>

#include "tests/daemon/fake_estimator.hpp"
#include "tests/daemon/quiet.hpp"
#include "tests/daemon/small_run.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using test::FakeEstimator;

Stages stages(Recording recording, double speed, FakeEstimator::OnUpdate on_update = {}) {
  return {.sources = test::played(std::move(recording), speed),
          .estimator = EstimatorStage(std::make_unique<FakeEstimator>(std::move(on_update)), Rig{}, StageSettings{}),
          .publisher = Publisher(quiet())};
}

/// Waits for the end of the recording; returns false on a timeout.
bool wait_until_finished(Pipeline& pipeline, Doorbell& bell) {
  const auto limit = std::chrono::steady_clock::now() + 60s;
  while (!pipeline.finished() && std::chrono::steady_clock::now() < limit) bell.wait(100ms);
  return pipeline.finished();
}

class PipelineSpeeds : public ::testing::TestWithParam<double> {};

TEST_P(PipelineSpeeds, GiveWhatAReplayWithoutThreadsGives) {
  const Recording recording = test::small_recording(60.0);
  const test::Replayed expected = test::replay(recording, std::make_unique<FakeEstimator>());
  ASSERT_EQ(expected.estimates.size(), recording.bearings.size());
  Doorbell bell;
  Pipeline pipeline(stages(recording, GetParam()), ThreadSettings{}, bell);
  pipeline.start();
  ASSERT_TRUE(wait_until_finished(pipeline, bell));
  pipeline.stop();
  EXPECT_EQ(pipeline.digest().estimates(), expected.estimates.size());
  EXPECT_EQ(digest_text(pipeline.digest().value()), digest_text(expected.digest.value()));
  Status status;
  ASSERT_TRUE(pipeline.take_status(status));
  EXPECT_EQ(status.digest, expected.digest.value());
  EXPECT_EQ(status.landmarks, expected.estimates.back().landmarks.size());
  EXPECT_EQ(status.samples_lost(), 0U);
}

INSTANTIATE_TEST_SUITE_P(All, PipelineSpeeds, ::testing::Values(0.0, 1000.0, 100.0), test::PrintedName());

TEST(Pipeline, SlowEstimatorMakesAPlayedSourceWaitAndLosesNothing) {
  const Recording recording = test::small_recording(100.0);
  const test::Replayed expected = test::replay(recording, std::make_unique<FakeEstimator>());
  Doorbell bell;
  Pipeline pipeline(stages(recording, 0.0, [](const BearingSet&) { std::this_thread::sleep_for(200us); }),
                    ThreadSettings{}, bell);
  pipeline.start();
  ASSERT_TRUE(wait_until_finished(pipeline, bell));
  pipeline.stop();
  EXPECT_EQ(pipeline.digest().value(), expected.digest.value());
}

TEST(Pipeline, SaysWhatIsWrongWithSamples) {
  Recording recording = test::small_recording(20.0);
  for (BearingSet& set : recording.bearings)
    for (Bearing& bearing : set.bearings) bearing.identity = kUnknownIdentity;
  Rig rig;
  rig.camera.identities = true;
  Doorbell bell;
  Pipeline pipeline({.sources = test::played(std::move(recording), 0.0),
                     .estimator = EstimatorStage(std::make_unique<FakeEstimator>(), rig, StageSettings{}),
                     .publisher = Publisher(quiet()),
                     .picture_trouble = "there is no image"},
                    ThreadSettings{}, bell);
  pipeline.start();
  ASSERT_TRUE(wait_until_finished(pipeline, bell));
  pipeline.stop();
  Status status;
  ASSERT_TRUE(pipeline.take_status(status));
  EXPECT_EQ(status.samples.trouble, SampleTrouble::no_identities);
  const status_t message = status_message(status);
  EXPECT_NE(message.input_trouble.find("camera.identities is true in rig.toml"), std::string::npos);
  EXPECT_NE(status_line(status, {}).find(message.input_trouble), std::string::npos);
  EXPECT_EQ(message.picture_trouble, "there is no image");
}

TEST(Pipeline, StopsWithinASecondInTheMiddleOfARun) {
  Doorbell bell;
  Pipeline pipeline(stages(test::small_recording(60.0), 1.0), ThreadSettings{}, bell);
  pipeline.start();
  std::this_thread::sleep_for(50ms);
  const auto start = std::chrono::steady_clock::now();
  pipeline.stop();
  EXPECT_LT(std::chrono::steady_clock::now() - start, 1s);
  EXPECT_TRUE(pipeline.finished()) << "the last status is published also then";
}

/// The result of a pipeline that ended early.
struct CutShort {
  std::vector<std::uint64_t> updates;  ///< Sequence numbers of the bearing sets that the estimator received
  bool started = false, stopped = false;
  bool finished = false;        ///< Whether it published its last status
  std::uint64_t estimates = 0;  ///< Number of estimates in the digest
  bool digest_is_told = false;  ///< Whether the last status contains the digest
};

/// Runs a pipeline for a moment. Every fifth one is never started, and every third one is destroyed without a stop.
CutShort cut_short(const Recording& recording, int round) {
  CutShort result;
  Doorbell bell;
  Pipeline pipeline(
      stages(recording, round % 2 ? 0.0 : 50.0, [&](const BearingSet& set) { result.updates.push_back(set.sequence); }),
      ThreadSettings{}, bell);
  result.started = round % 5 != 4;
  if (!result.started) return result;
  pipeline.start();
  std::this_thread::sleep_for(std::chrono::microseconds(137 * round));
  result.stopped = round % 3 != 0;
  if (!result.stopped) return result;
  pipeline.stop();
  Status status;
  result.finished = pipeline.finished();
  result.estimates = pipeline.digest().estimates();
  result.digest_is_told = pipeline.take_status(status) && status.digest == pipeline.digest().value();
  return result;
}

TEST(Pipeline, StartAndStopMayComeAtAnyTime) {
  const Recording recording = test::small_recording(20.0);
  std::set<std::size_t> lengths;
  for (int round = 0; round < 40; ++round) {
    const CutShort end = cut_short(recording, round);
    for (std::size_t i = 0; i < end.updates.size(); ++i) ASSERT_EQ(end.updates[i], i) << "round " << round;
    if (!end.started) {
      EXPECT_TRUE(end.updates.empty());
    }
    if (!end.stopped) continue;
    EXPECT_TRUE(end.finished) << "round " << round;
    EXPECT_EQ(end.estimates, end.updates.size()) << "each set that was used is an estimate that was published";
    EXPECT_TRUE(end.digest_is_told) << "round " << round;
    lengths.insert(end.updates.size());
  }
  EXPECT_GT(lengths.size(), 1U) << "all were cut at the same place";
}

TEST(Pipeline, AnEmptyRecordingEndsAtOnce) {
  Doorbell bell;
  Pipeline pipeline(stages({}, 1.0), ThreadSettings{}, bell);
  pipeline.start();
  EXPECT_TRUE(wait_until_finished(pipeline, bell));
}

TEST(Pipeline, NamesTheStageThatHangs) {
  std::atomic<bool> hang{true};
  Doorbell bell;
  ThreadSettings threads;
  threads.deadline_ms = 200;
  Pipeline pipeline(stages(test::small_recording(5.0), 0.0,
                           [&](const BearingSet&) {
                             while (hang) std::this_thread::sleep_for(1ms);
                           }),
                    threads, bell);
  EXPECT_EQ(pipeline.first_late(std::chrono::steady_clock::now()), nullptr);
  pipeline.start();
  std::this_thread::sleep_for(500ms);
  const StageThread* const late = pipeline.first_late(std::chrono::steady_clock::now());
  ASSERT_NE(late, nullptr);
  EXPECT_STREQ(late->spec().name, "estimator");
  hang = false;
  EXPECT_TRUE(wait_until_finished(pipeline, bell));
}

}  // namespace
}  // namespace azimuth
