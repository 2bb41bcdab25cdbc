#include "drivers/storage/run_log.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "tests/drivers/storage/log_text.hpp"
#include "tests/drivers/storage/samples.hpp"

namespace azimuth {
namespace {

using test::Buffer;
using test::collect;
using test::collected;
using test::LogText;
using ::testing::HasSubstr;

constexpr Stamp kStart{};

RC_GTEST_PROP(RunLog, FolderToLogToFolderKeepsEveryBit, (unsigned seed)) {
  const test::TemporaryFolder folder;
  const azimuth::Run run = test::example_run(30, seed);
  RC_ASSERT(write_run_log(run, folder / "a.lcm").has_value());
  const auto from_log = load_run(folder / "a.lcm");
  RC_ASSERT(static_cast<bool>(from_log));
  test::expect_same_samples(*from_log, run);
  RC_ASSERT(from_log->skipped == Skipped{});
  RC_ASSERT(write_run_folder(*from_log, folder / "b").has_value());
  test::expect_same_samples(*load_run(folder / "b"), run);
}

TEST(RunLog, NameAndRigPointBackToTheLog) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_run_log(test::example_run(), folder / "drive-7.lcm"));
  const auto run = load_run(folder / "drive-7.lcm");
  ASSERT_TRUE(run);
  EXPECT_EQ(run->name, "drive-7");
  EXPECT_EQ(run->rig_file, (folder / "drive-7.lcm").string() + " (rig.toml)");
  EXPECT_EQ(run->folder, folder.path());
}

TEST(RunLog, OriginsAndSequencesSurvive) {
  const test::TemporaryFolder folder;
  azimuth::Run run = test::example_run(5);
  run.odometry[3].origin = run.odometry[4].origin = 1;
  run.odometry[4].sequence = 40;
  ASSERT_TRUE(write_run_log(run, folder / "a.lcm"));
  test::expect_same_samples(*load_run(folder / "a.lcm"), run);
}

TEST(RunLog, EventsAreInTheOrderOfTheirStamps) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_run_log(test::example_run(10), folder / "a.lcm"));
  auto log = EventLogReader::open(folder / "a.lcm");
  ASSERT_TRUE(log);
  auto last = std::numeric_limits<std::int64_t>::min();
  std::string_view last_channel;
  while (const auto event = log->next()) {
    EXPECT_GE(event->utime_us, last);
    if (event->utime_us == last && last_channel == channel::kBearings) {
      EXPECT_NE(event->channel, channel::kOdometry) << "bearings need the odometry of their instant first";
    }
    last = event->utime_us;
    last_channel = event->channel;
  }
}

TEST(RunLog, ForeignChannelsAndOutputsAreCounted) {
  const azimuth::Run run = collected(LogText()
                                         .rig()
                                         .add("CAMERA", Buffer(1000))
                                         .odometry(0)
                                         .add(channel::kBotPose, Buffer(10))
                                         .add("azimuth_odom", Buffer(10))
                                         .add(channel::kStatus, Buffer())
                                         .bearings(0));
  EXPECT_EQ(run.skipped.foreign_events, 2U);
  EXPECT_EQ(run.skipped.output_events, 2U);
  EXPECT_EQ(run.skipped.text(), "2 events on foreign channels");
}

TEST(RunLog, MalformedMessagesAreCounted) {
  const OdometryReading wild{stamp_from_us(1), 0, 0, {test::kNaN, 0.0, 0.0}};
  const azimuth::Run run =
      collected(LogText()
                    .rig()
                    .odometry(0)
                    .add(channel::kOdometry, to_message(wild))
                    .add(channel::kOdometry, Buffer(59))
                    .add(channel::kBearings, Buffer())
                    .add(channel::kTruth, Buffer(60))
                    .add(channel::kTruthMap, Buffer(44))
                    .add(channel::kDocument, Buffer(3))
                    .add(channel::kDocument, to_message("frames.csv", "t_s,file\n0,../x\n", kStart))
                    .add(channel::kDocument, to_message("landmarks.csv", "id\n", kStart))
                    .bearings(0));
  EXPECT_EQ(run.skipped.malformed_messages, 8U);
  EXPECT_EQ(run.odometry.size(), 1U);
  EXPECT_TRUE(run.frames.empty());
}

TEST(RunLog, JumpsOfTheClockCostTheFewestRecords) {
  LogText log;
  log.rig().bearings(0);
  for (const std::int64_t utime_us : {10, 20, 1'000'000'000, 30, 30, 40, 5, 50}) log.odometry(utime_us);
  const azimuth::Run run = collected(log);
  EXPECT_EQ(run.skipped.odometry_not_in_order, 3U);
  std::vector<std::int64_t> stamps;
  for (const auto& reading : run.odometry) stamps.push_back(to_us(reading.stamp));
  EXPECT_THAT(stamps, ::testing::ElementsAre(10, 20, 30, 40, 50));
}

TEST(RunLog, FirstDocumentAndFirstLandmarkCount) {
  const std::vector<TrueLandmark> first{{1, 1.0, 1.0, test::kNaN, ""}};
  const std::vector<TrueLandmark> second{{1, 9.0, 9.0, test::kNaN, ""}, {2, 2.0, 2.0, test::kNaN, ""}};
  LogText log;
  log.rig().odometry(0).bearings(0).add(channel::kDocument, to_message("rig.toml", "other = 1\n", kStart));
  for (const auto& map : {first, second}) log.add(channel::kTruthMap, to_messages(map, kStart).front());
  const azimuth::Run run = collected(log);
  EXPECT_EQ(run.rig_toml, "x = 1\n");
  ASSERT_EQ(run.landmarks.size(), 2U);
  EXPECT_EQ(run.landmarks[0].x_m, 1.0);
}

TEST(RunLog, PrefixedChannelsAreReadAndWritten) {
  const test::TemporaryFolder folder;
  const azimuth::Run run = test::example_run();
  const LogOptions robot_1{.channel_prefix = "ROBOT1_"};
  ASSERT_TRUE(write_run_log(run, folder / "a.lcm", robot_1));
  test::expect_same_samples(*load_run(folder / "a.lcm", robot_1), run);
  const auto without = load_run(folder / "a.lcm");
  ASSERT_FALSE(without);
  EXPECT_THAT(text(without.error()), HasSubstr("events on foreign channels"));
}

TEST(RunLog, RigMayStandBesideTheLog) {
  const test::TemporaryFolder folder;
  const Buffer bytes = LogText().odometry(0).bearings(0).bytes();
  const std::string log(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  test::write(folder / "drive.lcm", log);
  EXPECT_EQ(text(load_run(folder / "drive.lcm").error()),
            (folder / "drive.lcm").string() + ": holds no rig.toml on AZIMUTH_DOCUMENT, and beside it " +
                (folder / "drive.rig.toml").string() +
                ": cannot be opened: No such file or directory; give it with --rig FILE, or find one: azimuth import "
                "makes a "
                "run folder without\n");
  const auto later = load_run(folder / "drive.lcm", {.rig_may_come_later = true});
  ASSERT_TRUE(later) << text(later.error());
  EXPECT_EQ(later->rig_toml, "");
  test::write(folder / "drive.rig.toml", "y = 2\n");
  const auto run = load_run(folder / "drive.lcm");
  ASSERT_TRUE(run);
  EXPECT_EQ(run->rig_toml, "y = 2\n");
  EXPECT_EQ(run->rig_file, (folder / "drive.rig.toml").string());
}

TEST(RunLog, AGivenRigTakesThePlaceOfTheLogsOwn) {
  const test::TemporaryFolder folder;
  test::write(folder / "other.toml", "y = 3\n");
  for (const bool has_its_own : {true, false}) {
    LogText log;
    if (has_its_own) log.rig();
    const azimuth::Run run = collected(log.odometry(0).bearings(0), {.rig_file = folder / "other.toml"});
    EXPECT_EQ(run.rig_toml, "y = 3\n");
    EXPECT_EQ(run.rig_file, (folder / "other.toml").string());
  }
  EXPECT_THAT(text(collect(LogText().rig().odometry(0).bearings(0).bytes(), {.rig_file = folder / "none"}).error()),
              HasSubstr("none: cannot be opened"));
}

pose_t bot_pose(std::int64_t utime_us, double x_m, double heading_rad) {
  pose_t pose{};
  pose.utime = utime_us;
  pose.pos[0] = x_m;
  pose.orientation[0] = std::cos(0.5 * heading_rad);
  pose.orientation[3] = std::sin(0.5 * heading_rad);
  return pose;
}

TEST(RunLog, OdometryOfOthersIsReadFromItsChannel) {
  LogText log;
  log.rig().bearings(0).odometry(7);  // Azimuth's own odometry must be ignored
  log.add("POSE", bot_pose(0, 1.0, 0.5)).add("POSE", bot_pose(100'000, 1.2, 0.6));
  log.add("POSE", bot_pose(200'000, 90.0, 0.0));  // farther than the robot can have rolled
  log.add("POSE", Buffer(112));
  pose_t no_rotation = bot_pose(300'000, 90.1, 0.0);
  no_rotation.orientation[0] = 0.0;
  log.add("POSE", no_rotation);
  const azimuth::Run run = collected(log, {.odometry_channel = "POSE"});
  ASSERT_EQ(run.odometry.size(), 3U);
  EXPECT_NEAR(run.odometry[1].T_odom_body.heading_rad, 0.6, 1e-12);
  EXPECT_EQ(run.odometry[1].T_odom_body.x_m, 1.2);
  for (std::uint64_t i = 0; i < 3; ++i) EXPECT_EQ(run.odometry[i].sequence, i);
  EXPECT_EQ(run.odometry[1].origin, run.odometry[0].origin);
  EXPECT_NE(run.odometry[2].origin, run.odometry[1].origin);
  EXPECT_EQ(run.skipped.malformed_messages, 2U);
}

TEST(RunLog, OdometryAloneIsARunWhereThatIsEnough) {
  const LogText log = LogText().rig().odometry(0).odometry(1);
  EXPECT_FALSE(collect(log.bytes()));
  const azimuth::Run run = collected(log, {.odometry_alone = true});
  EXPECT_EQ(run.odometry.size(), 2U);
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_run_folder(run, folder / "run"));
  EXPECT_THAT(text(load_run(folder / "run").error()), HasSubstr("has neither bearings.csv nor frames.csv"));
  EXPECT_TRUE(load_run(folder / "run", {.odometry_alone = true}));
}

void write_log(const std::filesystem::path& file, const LogText& log) {
  test::write(file, std::string(as_text(log.bytes())));
}

TEST(RunLog, PartsThatALoggerSplitAreOneRun) {
  const test::TemporaryFolder folder;
  write_log(folder / "drive.lcm.09", LogText().recorded_at(1'000'000).rig().odometry(0).bearings(0));
  write_log(folder / "drive.lcm.10", LogText().recorded_at(1'200'000).odometry(100'000).bearings(100'000));
  const auto run = load_run(folder / "drive.lcm.09");
  ASSERT_TRUE(run) << text(run.error());
  EXPECT_EQ(run->odometry.size(), 2U);
  EXPECT_EQ(run->bearings.size(), 2U);
}

/// lcm-logger numbers the separate recordings of a day in the same way as the parts of one recording.
TEST(RunLog, TheNextRecordingOfADayIsNoPart) {
  const test::TemporaryFolder folder;
  write_log(folder / "log.00", LogText().recorded_at(1'000'000).rig().odometry(0).bearings(0));
  write_log(folder / "log.01", LogText().recorded_at(60'000'000).odometry(100'000).bearings(100'000));
  write_log(folder / "log.02", LogText().recorded_at(60'100'000).odometry(100'000).bearings(100'000));
  EXPECT_EQ(load_run(folder / "log.00")->odometry.size(), 1U);
}

}  // namespace
}  // namespace azimuth
