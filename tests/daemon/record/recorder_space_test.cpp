// Segments of a recording, and disks that are full, small, slow or missing.

#include <csignal>
#include <fstream>
#include <gmock/gmock.h>
#include <sys/resource.h>

#include "daemon/record/recorder.hpp"
#include "drivers/storage/event_log.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/messages.hpp"
#include "tests/daemon/record/recorder_fixture.hpp"
#include "tests/daemon/record/recording.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using test::expect_readings;
using test::Feeder;
using test::RecorderTest;
using testing::HasSubstr;
using testing::MatchesRegex;

TEST_F(RecorderTest, SegmentsChangeBySize) {
  RecordSettings small = settings();
  small.max_file_mb = 0.05;
  {
    Feeder feeder(small);
    feeder.feed(5000);
    EXPECT_EQ(feeder.status().file, (session() / fs::path(feeder.status().file).filename()).string());
  }
  const auto segments = session_segments(session());
  EXPECT_GT(segments.size(), 8U);
  for (const SegmentFile& segment : segments) EXPECT_LE(fs::file_size(segment.file), 51'000U);
  expect_readings(test::load(session()), 0, 5000);
  // Each segment is a complete run by itself.
  const azimuth::Run third = test::load(segments[3].file);
  EXPECT_FALSE(third.from_the_start);
  EXPECT_EQ(third.rig_toml, test::documents()[0].text);
  expect_readings(third, third.odometry.front().sequence, third.odometry.back().sequence + 1);
}

TEST_F(RecorderTest, SegmentsChangeByAge) {
  RecordSettings brief = settings();
  brief.max_file_age_s = 10.0;
  { Feeder(brief).feed(3550); }
  EXPECT_EQ(session_segments(session()).size(), 4U);
  expect_readings(test::load(session()), 0, 3550);
}

TEST_F(RecorderTest, LargeDocumentsLeaveRoomForEvents) {
  RecordSettings small = settings();
  small.max_file_mb = 0.01;
  auto large = test::documents();
  large[0].text.assign(3'000'000, '#');
  {
    Recorder recorder(small, large);
    for (std::uint64_t i = 0; i < 2000; ++i) recorder.odometry(test::reading(i));
    recorder.bearings(test::bearing_set(0));
  }
  EXPECT_EQ(session_segments(session()).size(), 1U);
  EXPECT_EQ(test::load(session()).rig_toml, large[0].text);
  expect_readings(test::load(session()), 0, 2000);
}

TEST_F(RecorderTest, QuotaTakesTheOldestSegmentsFirst) {
  RecordSettings small = settings();
  small.max_file_mb = 0.05;
  { Feeder(small).feed(5000); }  // an older session of half a megabyte
  const fs::path older = session();
  small.quota_mb = 0.4;
  Feeder feeder(small);
  const fs::path current = session();
  ASSERT_NE(current, older);
  feeder.wait(2s);
  EXPECT_GT(feeder.status().segments_deleted, 0U);
  ASSERT_TRUE(fs::exists(older));
  EXPECT_GT(session_segments(older).front().number, 0U);
  feeder.feed(10'000);
  EXPECT_FALSE(fs::exists(older)) << "nothing was left in it";
  std::uintmax_t bytes = 0;
  for (const SegmentFile& segment : session_segments(current)) bytes += fs::file_size(segment.file);
  EXPECT_LE(bytes, 450'000U);
  EXPECT_GE(bytes, 300'000U);
  const azimuth::Run run = test::load(current);
  EXPECT_FALSE(run.from_the_start);
  EXPECT_GT(run.skipped.missing_segments, 0U);
  EXPECT_EQ(run.odometry.back().sequence / 100, 99U);
}

TEST_F(RecorderTest, ASmallQuotaHoldsAtLeastFourSegments) {
  RecordSettings small = settings();
  small.quota_mb = 0.2;
  Feeder feeder(small);
  feeder.feed(20'000);
  EXPECT_GE(session_segments(session()).size(), 3U);
  EXPECT_GE(test::load(session()).odometry.size(), 1000U);
}

TEST_F(RecorderTest, TheFloorStopsTheRecordingAndNothingElse) {
  RecordSettings greedy = settings();
  greedy.min_free_mb = 1e12;
  Feeder feeder(greedy);
  feeder.feed(1000);
  EXPECT_FALSE(feeder.status().on);
  EXPECT_THAT(feeder.status().reason, HasSubstr("MB are free on the disk of " + folder_.path().string()));
  ASSERT_TRUE(feeder.status().free_mb);
  EXPECT_EQ(feeder.status().lost_events, feeder.fed());
  EXPECT_EQ(feeder.status().events, 0U);
  EXPECT_TRUE(test::sessions(folder_.path()).empty());
}

TEST_F(RecorderTest, AFolderThatComesBackIsRecordedTo) {
  RecordSettings elsewhere = settings();
  elsewhere.folder = folder_ / "disk/logs";
  std::ofstream(folder_ / "disk") << "not a folder yet";
  {
    Feeder feeder(elsewhere);
    feeder.feed(300);
    EXPECT_FALSE(feeder.status().on);
    EXPECT_THAT(feeder.status().reason, HasSubstr("cannot be made"));
    fs::remove(folder_ / "disk");
    feeder.wait(31s);
    EXPECT_TRUE(feeder.status().on);
    EXPECT_EQ(feeder.status().reason, "");
    feeder.feed(300);
    EXPECT_EQ(feeder.status().lost_events, 330U);
  }
  const azimuth::Run run = test::load(test::sessions(elsewhere.folder).back());
  expect_readings(run, 300, 600);
  EXPECT_EQ(run.skipped.unrecorded_events, 330U);
}

TEST_F(RecorderTest, TriesEverMoreSeldom) {
  RecordSettings elsewhere = settings();
  elsewhere.folder = folder_ / "file";
  std::ofstream(elsewhere.folder) << "in the way";
  Feeder feeder(elsewhere);
  feeder.wait(100s);
  fs::remove(elsewhere.folder);
  feeder.wait(5s);
  EXPECT_FALSE(feeder.status().on) << "the pause had grown beyond 5 s";
  feeder.wait(26s);
  EXPECT_TRUE(feeder.status().on);
}

TEST_F(RecorderTest, GoesOnWhenItsFileIsDeleted) {
  Feeder feeder(settings());
  feeder.feed(100);
  fs::remove_all(session());
  feeder.feed(300);
  EXPECT_TRUE(feeder.status().on);
  const azimuth::Run run = test::load(session());
  EXPECT_FALSE(run.from_the_start);
  EXPECT_GT(run.odometry.size(), 150U);
}

/// Limits the size of files during its lifetime. The signal SIGXFSZ is ignored, as the recorder requires.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, SIG_DFL);
  }

 private:
  rlimit before_{};
};

TEST_F(RecorderTest, AFileThatMayNotGrowCostsWhatWaitedAndIsFollowedByAnother) {
  std::uint64_t lost = 0;
  {
    const FileSizeLimit limit(400'000);
    Feeder feeder(settings());
    feeder.feed(20'000);
    lost = feeder.status().lost_events;
    EXPECT_EQ(feeder.status().events + lost, feeder.fed()) << "every event is accounted for";
  }
  EXPECT_GT(session_segments(session()).size(), 3U);
  EXPECT_GT(lost, 0U);
  EXPECT_LT(lost, 2000U);
  const azimuth::Run run = test::load(session());
  EXPECT_EQ(run.odometry.size() + run.bearings.size() + lost, 22'000U);
  EXPECT_EQ(run.skipped.damaged_bytes, 0U);
  EXPECT_LE(run.skipped.unrecorded_events, lost);
  EXPECT_GT(run.skipped.unrecorded_events, 0U);
}

}  // namespace
}  // namespace azimuth
