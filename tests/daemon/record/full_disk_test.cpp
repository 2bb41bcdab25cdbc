// Recording to a disk that is really full. on_small_disk.sh provides a file system of 4 MB in $AZIMUTH_SMALL_DISK.

#include <cstdlib>
#include <fstream>
#include <gmock/gmock.h>

#include "tests/daemon/record/recording.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using test::Feeder;
using testing::HasSubstr;

class FullDisk : public testing::Test {
 protected:
  void SetUp() override { clear(); }
  void TearDown() override { clear(); }
  void clear() const {
    for (const auto& entry : fs::directory_iterator(disk_)) fs::remove_all(entry.path());
  }
  RecordSettings settings(double min_free_mb) const {
    RecordSettings settings;
    settings.folder = disk_ / "logs";
    settings.min_free_mb = min_free_mb;
    return settings;
  }
  /// Fills the disk with a file that is not a recording.
  void fill(const std::string& name, double megabytes) const {
    std::ofstream(disk_ / name) << std::string(static_cast<std::size_t>(megabytes * 1e6), 'x');
  }

  const fs::path disk_ = std::getenv("AZIMUTH_SMALL_DISK");
};

TEST_F(FullDisk, StopsTheLogAndResumesInANewSegment) {
  std::uint64_t lost = 0;
  {
    Feeder feeder(settings(0.0));
    feeder.feed(1000);
    fill("other", 3.8);
    feeder.feed(20'000);
    EXPECT_FALSE(feeder.status().on);
    EXPECT_THAT(feeder.status().reason, HasSubstr("No space left on device"));
    EXPECT_EQ(feeder.status().events + feeder.status().lost_events, feeder.fed());
    lost = feeder.status().lost_events;
    EXPECT_GT(lost, 0U);

    fs::remove(disk_ / "other");
    feeder.wait(31s);
    EXPECT_TRUE(feeder.status().on);
    feeder.feed(1000);
    EXPECT_EQ(feeder.status().lost_events, lost) << "nothing is lost once there is room";
  }
  const fs::path session = test::sessions(disk_ / "logs").back();
  EXPECT_GE(session_segments(session).size(), 2U);
  const azimuth::Run run = test::load(session);
  EXPECT_EQ(run.skipped.damaged_bytes, 0U);
  EXPECT_EQ(run.skipped.unrecorded_events, lost);
  EXPECT_EQ(run.odometry.size() + run.bearings.size() + lost, 24'200U);
  EXPECT_EQ(run.odometry.front(), test::reading(0));
  EXPECT_EQ(run.odometry.back(), test::reading(21'999));
}

TEST_F(FullDisk, TheFloorIsKept) {
  Feeder feeder(settings(1.0));
  feeder.feed(60'000);
  EXPECT_FALSE(feeder.status().on);
  EXPECT_THAT(feeder.status().reason, HasSubstr("less than 1 MB are free"));
  EXPECT_GE(fs::space(disk_).available, 900'000U) << "a second's worth below the floor at most";
  EXPECT_EQ(feeder.status().events + feeder.status().lost_events, feeder.fed());
}

TEST_F(FullDisk, OldSegmentsMakeRoomAboveTheFloor) {
  RecordSettings rotating = settings(1.0);
  rotating.max_file_mb = 0.2;
  Feeder feeder(rotating);
  feeder.feed(100'000);
  EXPECT_TRUE(feeder.status().on);
  EXPECT_GT(feeder.status().segments_deleted, 10U);
  EXPECT_EQ(feeder.status().lost_events, 0U);
  const azimuth::Run run = test::load(test::sessions(disk_ / "logs").back());
  EXPECT_GT(run.odometry.size(), 10'000U);
  EXPECT_GE(run.odometry.back().sequence, 99'970U);
}

TEST_F(FullDisk, ImagesGiveWayBeforeAnySample) {
  RecordSettings rotating = settings(1.0);
  rotating.max_file_mb = 0.2;
  { Feeder(rotating).feed(2000); }
  const fs::path older = test::sessions(disk_ / "logs").back();
  fs::create_directory(older / kFramesPart);
  for (std::uint64_t i = 0; i < 8; ++i) fill(fs::relative(older / kFramesPart / segment_name(i), disk_).string(), 0.25);
  Feeder feeder(rotating);
  feeder.feed(12'000);
  EXPECT_EQ(feeder.status().lost_events, 0U);
  const auto images = session_segments(older / kFramesPart);
  EXPECT_LT(images.size(), 8U);
  ASSERT_FALSE(images.empty()) << "no more than had to";
  EXPECT_EQ(images.back().number, 7U) << "the oldest first";
  EXPECT_EQ(test::load(older).odometry.size(), 2000U);
  EXPECT_EQ(feeder.status().segments_deleted, 8 - images.size());
}

TEST_F(FullDisk, ADiskThatWasFullAtTheStartIsRecordedToLater) {
  fill("other", 4.5);
  Feeder feeder(settings(0.0));
  feeder.feed(100);
  EXPECT_FALSE(feeder.status().on);
  fs::remove(disk_ / "other");
  feeder.wait(31s);
  feeder.feed(100);
  EXPECT_TRUE(feeder.status().on);
  EXPECT_EQ(feeder.status().lost_events, 110U);
}

}  // namespace
}  // namespace azimuth
