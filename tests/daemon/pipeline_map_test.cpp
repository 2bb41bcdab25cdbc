// Maps on their way from the estimator to the disk while the pipeline runs.

#include <fstream>
#include <gtest/gtest.h>

#include "daemon/pipeline/pipeline.hpp"
#include "drivers/storage/map_file.hpp"
#include "slam/planar/make_ekf_estimator.hpp"
#include "tests/daemon/quiet.hpp"
#include "tests/daemon/small_run.hpp"
#include "tests/support/temporary_folder.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

Rig small_rig() {
  Rig rig;
  rig.camera.identities = true;
  rig.camera.sigma_bearing_rad = 0.02;
  return rig;
}

class PipelineMap : public testing::Test {
 protected:
  Stages stages(double speed, double interval_s, bool saves = true) const {
    return {.sources = test::played(test::small_recording(60.0), speed),
            .estimator = EstimatorStage(make_ekf_estimator(small_rig(), {}), small_rig(), StageSettings{}),
            .publisher = Publisher(quiet()),
            .keeper = MapKeeper({file_.string(), interval_s}, {.text = "as it was"}, saves)};
  }

  test::TemporaryFolder folder_;
  fs::path file_ = folder_ / "map.azmap";
};

TEST_F(PipelineMap, IsSavedWhileTheRobotDrives) {
  Doorbell bell;
  Pipeline pipeline(stages(20.0, 0.2), ThreadSettings{}, bell);
  pipeline.start();
  Status status;
  bool said = false;
  for (int i = 0; i < 300 && !(said && fs::exists(previous_map(file_))); ++i) {
    bell.wait(100ms);
    if (pipeline.take_status(status)) said = said || status.map.text.find("saved with") != std::string::npos;
  }
  EXPECT_TRUE(said) << status.map.text;
  ASSERT_TRUE(fs::exists(previous_map(file_))) << "saved more than once";
  const auto early = read_map(file_);  // the pipeline is still running
  ASSERT_TRUE(early) << text(early.error());
  EXPECT_GT(early->map.landmarks.size(), 0u);
  pipeline.stop();
}

TEST_F(PipelineMap, IsSavedOnAStop) {
  {
    Doorbell bell;
    Pipeline pipeline(stages(0.0, 0.0), ThreadSettings{}, bell);
    pipeline.start();
    for (int i = 0; i < 300 && !pipeline.finished(); ++i) bell.wait(100ms);
    EXPECT_FALSE(fs::exists(file_));
    pipeline.stop();
    EXPECT_TRUE(fs::exists(file_));
  }
  EXPECT_FALSE(fs::exists(previous_map(file_))) << "once";
  const auto map = read_map(file_);
  ASSERT_TRUE(map);
  EXPECT_EQ(map->map.landmarks.size(), 6u);
  EXPECT_EQ(map->map.stamp, test::small_recording(60.0).bearings.back().stamp);
}

TEST_F(PipelineMap, IsNeverWrittenByARobotThatOnlyLocalises) {
  {
    Doorbell bell;
    Pipeline pipeline(stages(0.0, 0.05, false), ThreadSettings{}, bell);
    pipeline.start();
    Status status;
    for (int i = 0; i < 300 && !pipeline.finished(); ++i) bell.wait(100ms);
    while (pipeline.take_status(status)) continue;
    EXPECT_EQ(status.map.text, "as it was");
  }
  EXPECT_FALSE(fs::exists(file_));
}

TEST_F(PipelineMap, TroubleWithTheDiskIsSaidAndStopsNothing) {
  fs::create_directories((fs::path(file_) += ".new") / "in the way");
  Doorbell bell;
  Pipeline pipeline(stages(30.0, 0.1), ThreadSettings{}, bell);
  pipeline.start();
  Status status;
  for (int i = 0; i < 300 && !(status.map.trouble && pipeline.finished()); ++i) {
    bell.wait(100ms);
    pipeline.take_status(status);
  }
  EXPECT_TRUE(status.map.trouble);
  EXPECT_NE(status.map.text.find("cannot be written"), std::string::npos) << status.map.text;
  EXPECT_NE(status_line(status, {}).find("map: "), std::string::npos);
  EXPECT_EQ(status_message(status).map_trouble, status.map.text);
  EXPECT_TRUE(pipeline.finished());
}

TEST_F(PipelineMap, AMapThatCannotBeStartedFromIsSetAsideAndNoneIsLost) {
  MapSnapshot old;
  old.landmarks.resize(1);
  old.next_id = 1;
  old.covariance.resize(old.entries());
  for (int start = 1; start <= 2; ++start) {
    MapKeeper keeper({file_.string(), 1.0}, {.text = "cannot be started from", .trouble = true, .unfit = start == 2},
                     true);
    keeper.save(old);
    keeper.save(old);
    EXPECT_FALSE(keeper.status().trouble) << keeper.status().text;
  }
  EXPECT_TRUE(fs::exists(file_.string() + ".aside.1"));
  EXPECT_FALSE(fs::exists(file_.string() + ".aside.2")) << "once a start";
  EXPECT_TRUE(read_map_only(file_));
}

TEST(MapKeeper, IsDueOnceInAnInterval) {
  MapKeeper keeper({"unused", 10.0}, {}, true);
  const MapKeeper::Clock::time_point start{};
  EXPECT_FALSE(keeper.is_due(start));
  EXPECT_FALSE(keeper.is_due(start + 9s));
  EXPECT_TRUE(keeper.is_due(start + 10s));
  EXPECT_FALSE(keeper.is_due(start + 10s));
  EXPECT_TRUE(keeper.is_due(start + 25s)) << "late, but not made up for";
  EXPECT_FALSE(keeper.is_due(start + 26s));
  MapKeeper never({"unused", 0.0}, {}, true);
  EXPECT_FALSE(never.is_due(start + 10000s));
}

// The interval counts from the age of the existing map. Otherwise a daemon that is killed before an interval has passed
// would never renew its map.
TEST(MapKeeper, CountsFromTheMapThatAStartBeforeLeft) {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "map.azmap";
  std::ofstream(file) << "a map";
  fs::last_write_time(file, fs::file_time_type::clock::now() - 1h);
  MapKeeper keeper({file.string(), 10.0}, {}, true);
  const MapKeeper::Clock::time_point start{};
  EXPECT_FALSE(keeper.is_due(start)) << "nobody tracks yet";
  EXPECT_TRUE(keeper.is_due(start + 1s));
  EXPECT_FALSE(keeper.is_due(start + 10s));
  EXPECT_TRUE(keeper.is_due(start + 11s));
  fs::last_write_time(file, fs::file_time_type::clock::now() + 1h);
  MapKeeper after_clock_was_set({file.string(), 10.0}, {}, true);
  EXPECT_FALSE(after_clock_was_set.is_due(start));
  EXPECT_FALSE(after_clock_was_set.is_due(start + 9s));
  EXPECT_TRUE(after_clock_was_set.is_due(start + 10s));
}

TEST(MapKeeper, AsksAgainSoonWhereThereWasNothingToSave) {
  const test::TemporaryFolder folder;
  MapKeeper keeper({(folder.path() / "map.azmap").string(), 10.0}, {}, true);
  const MapKeeper::Clock::time_point start{};
  EXPECT_FALSE(keeper.is_due(start));
  EXPECT_TRUE(keeper.is_due(start + 10s));
  EXPECT_FALSE(keeper.save({})) << "the robot is lost";
  EXPECT_FALSE(keeper.is_due(start + 10s));
  EXPECT_TRUE(keeper.is_due(start + 11s));
  EXPECT_FALSE(keeper.is_due(start + 12s));
  EXPECT_TRUE(keeper.is_due(start + 21s));
}

TEST(MapKeeper, WritesNothingAbsurdOverAGoodMap) {
  const test::TemporaryFolder folder;
  MapSnapshot map;
  map.landmarks.resize(1);
  map.next_id = 1;
  map.covariance.resize(map.entries());
  MapKeeper keeper({folder / "map.azmap", 10.0}, {}, true);
  keeper.save(map);
  EXPECT_EQ(keeper.status().saved, 1u);
  map.landmarks[0].p_map_landmark_m.x() = std::nan("");
  keeper.save(map);
  EXPECT_EQ(keeper.status().failed, 1u);
  EXPECT_TRUE(keeper.status().trouble);
  EXPECT_TRUE(read_map_only(folder / "map.azmap"));
}

}  // namespace
}  // namespace azimuth
