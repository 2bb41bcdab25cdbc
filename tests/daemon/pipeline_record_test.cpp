// The recorder at the end of the pipeline records exactly the samples that the estimator used, so a replay gives the
// same estimates to the last bit.

#include <gmock/gmock.h>
#include <thread>

#include "daemon/pipeline/pipeline.hpp"
#include "drivers/storage/event_log.hpp"
#include "drivers/storage/recorded_outputs.hpp"
#include "drivers/storage/run.hpp"
#include "drivers/wire/messages.hpp"
#include "tests/daemon/child_process.hpp"
#include "tests/daemon/fake_estimator.hpp"
#include "tests/daemon/quiet.hpp"
#include "tests/daemon/small_run.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

Stages recorded_stages(Recording recording, double speed, RecordSettings record) {
  return {.sources = test::played(std::move(recording), speed),
          .estimator = EstimatorStage(std::make_unique<test::FakeEstimator>(), Rig{}, StageSettings{}),
          .publisher = Publisher(quiet()),
          .recorder = Recorder(std::move(record), {{"rig.toml", test::kSmallRig}})};
}

class PipelineRecord : public testing::Test {
 protected:
  RecordSettings settings() const {
    RecordSettings settings;
    settings.folder = folder_.path().string();
    settings.min_free_mb = 1.0;
    return settings;
  }
  /// The only session in the recording folder.
  std::filesystem::path session() const { return std::filesystem::directory_iterator(folder_.path())->path(); }

  test::TemporaryFolder folder_;
};

TEST_F(PipelineRecord, IsPlayedAgainToTheSameBits) {
  const Recording recording = test::small_recording(120.0);
  Doorbell bell;
  Pipeline pipeline(recorded_stages(recording, 100.0, settings()), ThreadSettings{}, bell);
  pipeline.start();
  for (int i = 0; i < 600 && !pipeline.finished(); ++i) bell.wait(100ms);
  pipeline.stop();
  EXPECT_EQ(pipeline.losses().records_refused, 0U);

  FileResult<azimuth::Run> run = load_run(session());
  ASSERT_TRUE(run) << text(run.error());
  EXPECT_EQ(run->odometry.size(), recording.odometry.size());
  EXPECT_EQ(run->bearings.size(), recording.bearings.size());
  EXPECT_EQ(run->rig_toml, test::kSmallRig);
  const test::Replayed replayed =
      test::replay({std::move(run->odometry), std::move(run->bearings)}, std::make_unique<test::FakeEstimator>());
  EXPECT_EQ(digest_text(replayed.digest.value()), digest_text(pipeline.digest().value()));

  const FileResult<std::vector<RecordedPose>> poses = read_recorded_poses(session());
  ASSERT_TRUE(poses);
  ASSERT_FALSE(poses->empty());  // a fast run does not publish every step
  for (const RecordedPose& pose : *poses) {
    const Estimate& estimate = replayed.estimates.at(static_cast<std::size_t>(pose.step) - 1);
    EXPECT_EQ(pose.stamp, estimate.stamp);
    EXPECT_EQ(pose.T_map_body, estimate.T_map_body);
  }
}

TEST_F(PipelineRecord, TheLogIsInTheOrderOfTheStampsHoweverFastItIsPlayed) {
  {
    Doorbell bell;
    Pipeline pipeline(recorded_stages(test::small_recording(60.0), 0.0, settings()), ThreadSettings{}, bell);
    pipeline.start();
    for (int i = 0; i < 600 && !pipeline.finished(); ++i) bell.wait(100ms);
    pipeline.stop();
    ASSERT_EQ(pipeline.losses().records_refused, 0U);
  }
  auto log = EventLogReader::open(session() / "000.lcm");
  ASSERT_TRUE(log);
  Stamp last = Stamp::min();
  std::int64_t last_utime_us = 0;
  std::size_t samples = 0;
  while (const auto event = log->next()) {
    EXPECT_GE(event->utime_us, last_utime_us);
    last_utime_us = event->utime_us;
    const auto reading = decode_odometry(event->data);
    const auto set = decode_bearings(event->data);
    if (!reading && !set) continue;
    const Stamp stamp = reading ? reading->stamp : set->stamp;
    EXPECT_GE(stamp, last);
    last = stamp;
    ++samples;
  }
  EXPECT_EQ(samples, 601U + 240U) << "fewer than wait for the disk at most";
}

TEST_F(PipelineRecord, SaysWhereItRecordsAndWhyNot) {
  for (const bool can_record : {true, false}) {
    RecordSettings record = settings();
    if (!can_record) record.folder = "/dev/null/recordings";
    Doorbell bell;
    Pipeline pipeline(recorded_stages(test::small_recording(3.0), 1.0, record), ThreadSettings{}, bell);
    pipeline.start();
    Status status;
    for (int i = 0; i < 100 && status.record.text.empty(); ++i) {
      bell.wait(100ms);
      pipeline.take_status(status);
    }
    pipeline.stop();
    EXPECT_THAT(status.record.text, testing::HasSubstr(can_record ? "000.lcm" : "/dev/null/recordings"));
    EXPECT_GT(pipeline.digest().estimates(), 0U) << "recording or not, poses are made";
  }
}

}  // namespace
}  // namespace azimuth
