#include <gmock/gmock.h>
#include <sys/stat.h>

#include "drivers/storage/run.hpp"
#include "tests/drivers/storage/samples.hpp"

namespace azimuth {
namespace {

using ::testing::HasSubstr;

class RunFolder : public ::testing::Test {
 protected:
  /// The errors of loading as text; empty if the run loads.
  std::string errors() const {
    const auto run = load_run(folder_.path());
    return run ? "" : text(run.error());
  }
  std::string in(const std::string& name) const { return (folder_ / name).string(); }

  void SetUp() override {
    test::write(folder_ / "rig.toml", "front_end = \"bearings\"\n");
    test::write(folder_ / "odometry.csv", "t_s,x_m,y_m,heading_rad\n0,0,0,0\n1,1,0,0\n");
    test::write(folder_ / "bearings.csv", "t_s,azimuth_rad,landmark_id\n0,0.5,1\n0,1,2\n1,0.6,1\n");
  }

  test::TemporaryFolder folder_;
};

TEST_F(RunFolder, Loads) {
  const auto run = load_run(folder_.path());
  ASSERT_TRUE(run) << text(run.error());
  EXPECT_EQ(run->name, folder_.path().filename());
  EXPECT_EQ(run->rig_toml, "front_end = \"bearings\"\n");
  EXPECT_EQ(run->rig_file, in("rig.toml"));
  EXPECT_EQ(run->odometry.size(), 2U);
  EXPECT_EQ(run->bearings.size(), 2U);
  EXPECT_EQ(run->skipped, Skipped{});
  EXPECT_EQ(load_run(folder_.path() / "")->name, run->name) << "a slash at the end changes nothing";
}

TEST_F(RunFolder, WritesAndReadsEveryBit) {
  const azimuth::Run run = test::example_run(50);
  ASSERT_TRUE(write_run_folder(run, folder_ / "out"));
  const auto back = load_run(folder_ / "out");
  ASSERT_TRUE(back) << text(back.error());
  test::expect_same_samples(*back, run);
}

TEST_F(RunFolder, KeepsWhereAnOdometerBeganAnewAndWhatItDoubts) {
  azimuth::Run run = test::example_run(50);
  for (std::size_t i = 20; i < run.odometry.size(); ++i) run.odometry[i].origin = 1;
  run.odometry[20].sigma_gap_m = 0.1;
  run.odometry[20].sigma_gap_rad = 0.25;
  ASSERT_TRUE(write_run_folder(run, folder_ / "out"));
  const auto back = load_run(folder_ / "out");
  ASSERT_TRUE(back) << text(back.error());
  test::expect_same_samples(*back, run);
}

TEST_F(RunFolder, PartsOdometryThatBeginsAnewWithoutAWord) {
  std::string table = "t_s,x_m,y_m,heading_rad\n";
  for (int i = 0; i < 100; ++i) table += std::to_string(0.1 * i) + ',' + std::to_string(0.03 * (i % 60)) + ",0,0\n";
  test::write(folder_ / "odometry.csv", table);
  const auto run = load_run(folder_.path());
  ASSERT_TRUE(run) << text(run.error());
  EXPECT_EQ(run->odometry[59].origin, 0U);
  EXPECT_EQ(run->odometry[60].origin, 1U);
  EXPECT_GT(run->odometry[60].sigma_gap_m, 0.0);
  ASSERT_TRUE(write_run_folder(*run, folder_ / "out"));
  test::expect_same_samples(*load_run(folder_ / "out"), *run);
}

TEST_F(RunFolder, ReadsTruthWithoutHeading) {
  test::write(folder_ / "truth.csv", "t_s,x_m,y_m\n0,1,2\n1,1.5,2\n");
  const auto run = load_run(folder_.path());
  ASSERT_TRUE(run) << text(run.error());
  ASSERT_EQ(run->truth.size(), 2U);
  EXPECT_EQ(run->truth[1].T_world_body.x_m, 1.5);
  EXPECT_TRUE(std::isnan(run->truth[1].T_world_body.heading_rad));
  ASSERT_TRUE(write_run_folder(*run, folder_ / "out"));
  EXPECT_EQ(load_run(folder_ / "out")->truth.size(), 2U);
  EXPECT_THAT(write_run_log(*run, folder_ / "out.lcmlog").error().front().message,
              HasSubstr("cannot hold truth without heading; a run folder can"));
}

TEST_F(RunFolder, WritingRemovesTablesOfAnEarlierRun) {
  azimuth::Run run = test::example_run();
  ASSERT_TRUE(write_run_folder(run, folder_.path()));
  run.truth.clear();
  run.landmarks.clear();
  run.frames.clear();
  ASSERT_TRUE(write_run_folder(run, folder_.path()));
  test::expect_same_samples(*load_run(folder_.path()), run);
}

TEST_F(RunFolder, WhatTablesCannotHoldIsRefused) {
  azimuth::Run run = test::example_run();
  run.landmarks.back().kind = "red,blue";
  EXPECT_THAT(write_run_folder(run, folder_ / "out").error().front().message, HasSubstr("commas"));
  run = test::example_run();
  run.frames.back().file = "a\nb";
  EXPECT_THAT(write_run_folder(run, folder_ / "out").error().front().message, HasSubstr("commas"));
  run = test::example_run();
  run.bearings.push_back(test::feature_set(3, 1000));
  EXPECT_THAT(write_run_folder(run, folder_ / "out").error().front().message, HasSubstr("what features look like"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(RunFolder, FoldersThatCannotBeMadeAreNamed) {
  test::write(folder_ / "file", "");
  const auto written = write_run_folder(test::example_run(), folder_ / "file/out");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().front().text(), in("file/out") + ": cannot be made: Not a directory");
}

TEST_F(RunFolder, MissingPathIsAnError) {
  EXPECT_EQ(text(load_run(folder_ / "nowhere").error()), in("nowhere") + ": does not exist\n");
}

TEST_F(RunFolder, MissingFilesAreNamedTogether) {
  const test::TemporaryFolder empty;
  const std::string at = empty.path().string();
  EXPECT_EQ(text(load_run(empty.path()).error()), at + "/rig.toml: cannot be opened: No such file or directory\n" + at +
                                                      "/odometry.csv: cannot be opened: No such file or directory\n" +
                                                      at + ": has neither bearings.csv nor frames.csv\n");
}

TEST_F(RunFolder, ARigMayComeLater) {
  azimuth::Run run = test::example_run();
  ASSERT_TRUE(write_run_folder(run, folder_.path()));
  run.rig_toml.clear();
  ASSERT_TRUE(write_run_folder(run, folder_.path()));
  EXPECT_EQ(test::read(folder_ / "rig.toml"), test::example_run().rig_toml) << "which was there already";
  std::filesystem::remove(folder_ / "rig.toml");
  ASSERT_TRUE(write_run_folder(run, folder_.path()));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "rig.toml"));
  const auto later = load_run(folder_.path(), {.rig_may_come_later = true});
  ASSERT_TRUE(later) << text(later.error());
  EXPECT_EQ(later->rig_toml, "");
  test::expect_same_samples(*later, run);
  EXPECT_EQ(
      text(load_run(folder_.path()).error()),
      in("rig.toml") + ": there is none yet; give one with --rig FILE, or make one first: azimuth calibrate " +
          folder_.path().string() + " --out " + in("rig.toml") +
          ", for a mirror camera; or azimuthd --print-rig-settings > " + in("rig.toml") +
          ", every key at its default, to be changed there (camera.identities = true where bearings carry names)\n");
  EXPECT_FALSE(load_run(folder_.path(), {.rig_file = folder_ / "gone.toml", .rig_may_come_later = true}))
      << "one that was asked for";
}

TEST_F(RunFolder, EmptyTablesAreErrors) {
  test::write(folder_ / "odometry.csv", "");
  test::write(folder_ / "bearings.csv", "t_s,azimuth_rad\n");
  EXPECT_EQ(errors(), in("odometry.csv") + ": is empty\n" + in("bearings.csv") + ": has no rows\n");
}

TEST_F(RunFolder, ErrorsOfAllTablesAreListedAtOnce) {
  test::write(folder_ / "odometry.csv", "t_s,x_m,y_m,heading\n0,0,0,0\n");
  test::write(folder_ / "bearings.csv", "t_s,azimuth_rad\n0,left\n");
  test::write(folder_ / "truth.csv", "t_s,x_m,y_m,heading_rad\n1,0,0,0\n0,0,0,0\n");
  test::write(folder_ / "landmarks.csv", "landmark_id,x_m,y_m\n1,nan,0\n");
  EXPECT_EQ(errors(), in("odometry.csv") + ":1: unknown column \"heading\"; the column is heading_rad, in rad\n" +  //
                          in("odometry.csv") + ":1: missing column heading_rad\n" +                                 //
                          in("bearings.csv") + ":2: azimuth_rad \"left\" is not a number\n" +                       //
                          in("truth.csv") + ":3: t_s is earlier than in the row above\n" +                          //
                          in("landmarks.csv") + ":2: x_m \"nan\" is not finite\n");
}

TEST_F(RunFolder, RepeatedOdometryIsCounted) {
  test::write(folder_ / "odometry.csv", "t_s,x_m,y_m,heading_rad\n0,0,0,0\n0,0,0,0\n1,1,0,0\n");
  const auto run = load_run(folder_.path());
  ASSERT_TRUE(run);
  EXPECT_EQ(run->skipped.text(), "1 odometry readings not in order");
}

TEST_F(RunFolder, TablesMustBeFiles) {
  std::filesystem::remove(folder_ / "odometry.csv");
  std::filesystem::create_directory(folder_ / "odometry.csv");
  EXPECT_EQ(errors(), in("odometry.csv") + ": is not a regular file\n");
  std::filesystem::remove(folder_ / "odometry.csv");
  ASSERT_EQ(::mkfifo((folder_ / "odometry.csv").c_str(), 0600), 0);
  EXPECT_EQ(errors(), in("odometry.csv") + ": is not a regular file\n") << "a pipe must not keep us waiting";
}

}  // namespace
}  // namespace azimuth
