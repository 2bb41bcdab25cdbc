// Runs `azimuth import` on MCAP files.

#include <cmath>
#include <gtest/gtest.h>
#include <tuple>
#include <zstd.h>

#include "drivers/storage/run.hpp"
#include "tests/support/places.hpp"
#include "tests/tools/azimuth/command_line.hpp"
#include "tests/tools/import/database_bag.hpp"
#include "tests/tools/import/ros2_messages.hpp"

namespace azimuth::test {
namespace {

namespace fs = std::filesystem;

/// 10 s of odometry at 10 Hz, one image per second and a topic that the import ignores.
std::string recorded_drive() {
  std::string records = mcap_schema(1, kRos2Odometry) + mcap_channel(1, 1, "/odom") + mcap_schema(2, kRos2Image) +
                        mcap_channel(2, 2, "/camera/image_raw") + mcap_channel(3, 0, "/log", "json");
  for (int i = 0; i < 100; ++i) {
    const double t_s = 1000.0 + 0.1 * i;
    records += mcap_message(1, t_s, ros2_odometry(t_s, 0.05 * i, 0.0, 0.0, 1.0));
    if (i % 10 == 0) records += mcap_message(2, t_s, ros2_image(t_s, 8, 6, "mono8", 8, std::string(48, 'x')));
    records += mcap_message(3, t_s, "{}");
  }
  return kMcapBegin + mcap_chunk(records, "", records) + kMcapEnd;
}

azimuth::Run imported(const std::string& out) {
  auto run = load_run(out, {.rig_file = one_lap() + "/rig.toml", .odometry_alone = true});
  EXPECT_TRUE(run) << text(run.error());
  return run ? *std::move(run) : azimuth::Run{};
}

TEST(McapImport, MakesARunFolder) {
  const ScratchFolder scratch;
  write_file(scratch / "drive.mcap", recorded_drive());
  const Outcome outcome = azimuth({"import", scratch / "drive.mcap", scratch / "run"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const azimuth::Run run = imported(scratch / "run");
  ASSERT_EQ(run.odometry.size(), 100u);
  EXPECT_EQ(run.odometry[37].stamp, stamp_from_us(1'003'700'000));
  EXPECT_NEAR(run.odometry[37].T_odom_body.x_m, 1.85, 1e-12);
  EXPECT_EQ(run.frames.size(), 10u);
}

/// Odometry of 10 s from `begin_s` on: one part of a recording that ROS 2 has split.
std::string part_of_drive(double begin_s) {
  std::string records = mcap_schema(1, kRos2Odometry) + mcap_channel(1, 1, "/odom");
  for (int i = 0; i < 100; ++i) {
    const double t_s = begin_s + 0.1 * i;
    records += mcap_message(1, t_s, ros2_odometry(t_s, 0.05 * (t_s - 1000.0), 0.0, 0.0, 1.0));
  }
  return kMcapBegin + records + kMcapEnd;
}

TEST(McapImport, TakesTheFolderAroundItWithAllItsParts) {
  const ScratchFolder scratch;
  fs::create_directory(scratch / "bag");
  write_file(scratch / "bag/metadata.yaml", "rosbag2_bagfile_information:\n");
  write_file(scratch / "bag/bag_9.mcap", part_of_drive(1000.0));
  write_file(scratch / "bag/bag_10.mcap", part_of_drive(1010.0));
  ASSERT_EQ(azimuth({"import", scratch / "bag", scratch / "run"}).code, 0);
  const azimuth::Run run = imported(scratch / "run");
  EXPECT_EQ(run.odometry.size(), 200u);
  EXPECT_EQ(run.odometry.back().stamp, stamp_from_us(1'019'900'000));
}

TEST(McapImport, TakesThePartsThatMetadataNames) {
  const ScratchFolder scratch;
  fs::create_directory(scratch / "bag");
  write_file(scratch / "bag/metadata.yaml",
             "rosbag2_bagfile_information:\n  version: 5\n  relative_file_paths:\n    - first.mcap\n"
             "    - \"second.mcap\"\n  duration:\n    nanoseconds: 1\n");
  write_file(scratch / "bag/first.mcap", part_of_drive(1000.0));
  write_file(scratch / "bag/other.mcap", part_of_drive(1000.0));
  const Outcome refused = azimuth({"import", scratch / "bag", scratch / "run"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("lacks second.mcap, which metadata.yaml names"), std::string::npos) << refused.err;
  write_file(scratch / "bag/second.mcap", part_of_drive(1010.0));
  ASSERT_EQ(azimuth({"import", scratch / "bag", scratch / "run"}).code, 0);
  EXPECT_EQ(imported(scratch / "run").odometry.size(), 200u);
}

TEST(McapImport, RefusesAFolderOfSeveralRecordingsAndOneThatLacksAPart) {
  const ScratchFolder scratch;
  fs::create_directory(scratch / "bags");
  write_file(scratch / "bags/a.mcap", part_of_drive(1000.0));
  write_file(scratch / "bags/b.mcap", part_of_drive(1000.0));
  const Outcome several = azimuth({"import", scratch / "bags", scratch / "run"});
  EXPECT_EQ(several.code, 2);
  EXPECT_NE(several.err.find("holds 2 bags, such as a.mcap and b.mcap"), std::string::npos) << several.err;
  fs::create_directory(scratch / "gap");
  write_file(scratch / "gap/a_0.mcap", part_of_drive(1000.0));
  write_file(scratch / "gap/a_2.mcap", part_of_drive(1020.0));
  const Outcome gap = azimuth({"import", scratch / "gap", scratch / "run"});
  EXPECT_EQ(gap.code, 2);
  EXPECT_NE(gap.err.find("a part is missing"), std::string::npos) << gap.err;
}

TEST(McapImport, OfOnePartSaysThatThereAreOthers) {
  const ScratchFolder scratch;
  write_file(scratch / "a_2026-01-01-10-00-00_0.mcap", part_of_drive(1000.0));
  write_file(scratch / "a_2026-01-01-10-10-00_1.mcap", part_of_drive(1010.0));
  const Outcome one = azimuth({"import", scratch / "a_2026-01-01-10-00-00_0.mcap", scratch / "run"});
  EXPECT_EQ(one.code, 0);
  EXPECT_NE(one.err.find("is one of 2 parts"), std::string::npos) << one.err;
  EXPECT_EQ(azimuth({"import", scratch / "", scratch / "all"}).code, 0);
  EXPECT_EQ(imported(scratch / "all").odometry.size(), 200u);
}

/// Odometry of two senders on one topic in turns, 0.25 m apart.
std::string mixed_drive(const std::string& first, const std::string& second, const std::string& frame) {
  std::string records = mcap_schema(1, kRos2Odometry) + mcap_channel(1, 1, "/odom", "cdr", first) +
                        mcap_channel(2, 1, "/odom", "cdr", second);
  for (int i = 0; i < 100; ++i) {
    const double t_s = 1000.0 + 0.1 * i;
    records += mcap_message(1, t_s, ros2_odometry(t_s, 0.05 * i, 0.0, 0.0, 1.0));
    records +=
        mcap_message(frame == "base" ? 2 : 1, t_s + 0.04, ros2_odometry(t_s + 0.04, 0.05 * i, 0.25, 0.0, 1.0, frame));
  }
  return kMcapBegin + records + kMcapEnd;
}

TEST(McapImport, NamesSeveralSendersOfATopicAndTakesTheOneThatIsChosen) {
  const ScratchFolder scratch;
  for (const auto& [first, second, wish] : {std::tuple{"/base", "/ekf", "/ekf"}, std::tuple{"", "", "channel 2"}}) {
    write_file(scratch / "drive.mcap", mixed_drive(first, second, "base"));
    const Outcome refused = azimuth({"import", scratch / "drive.mcap", scratch / "run"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find(std::string(wish) + " (100 messages)"), std::string::npos) << refused.err;
    EXPECT_NE(refused.err.find("--sender"), std::string::npos) << refused.err;
    const Outcome chosen = azimuth({"import", scratch / "drive.mcap", scratch / "run", "--sender", wish, "--force"});
    ASSERT_EQ(chosen.code, 0) << chosen.err;
    const azimuth::Run run = imported(scratch / "run");
    ASSERT_EQ(run.odometry.size(), 100u);
    for (const OdometryReading& reading : run.odometry) EXPECT_EQ(reading.T_odom_body.y_m, 0.25);
    fs::remove_all(scratch / "run");
  }
}

TEST(McapImport, NamesSeveralFramesOfATopicAndTakesTheOneThatIsChosen) {
  const ScratchFolder scratch;
  write_file(scratch / "drive.mcap", mixed_drive("/a", "/a", "other"));
  const Outcome refused = azimuth({"import", scratch / "drive.mcap", scratch / "run"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("odom -> base (100 messages), odom -> other (100 messages)"), std::string::npos)
      << refused.err;
  const Outcome unknown = azimuth({"import", scratch / "drive.mcap", scratch / "run", "--sender", "nobody"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("--sender nobody: nobody sends so on /odom"), std::string::npos) << unknown.err;
  ASSERT_EQ(azimuth({"import", scratch / "drive.mcap", scratch / "run", "--sender", "other"}).code, 0);
  for (const OdometryReading& reading : imported(scratch / "run").odometry) EXPECT_EQ(reading.T_odom_body.y_m, 0.25);
}

TEST(McapImport, OneSenderAfterAnotherIsStartedAnewAndTaken) {
  const ScratchFolder scratch;
  std::string records = mcap_schema(1, kRos2Odometry) + mcap_channel(1, 1, "/odom", "cdr", "/base_1") +
                        mcap_channel(2, 1, "/odom", "cdr", "/base_2");
  for (int i = 0; i < 100; ++i)
    records += mcap_message(i < 50 ? 1 : 2, 1000.0 + 0.1 * i, ros2_odometry(1000.0 + 0.1 * i, 0.05 * i, 0.0, 0.0, 1.0));
  write_file(scratch / "drive.mcap", kMcapBegin + records + kMcapEnd);
  const Outcome outcome = azimuth({"import", scratch / "drive.mcap", scratch / "run"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(imported(scratch / "run").odometry.size(), 100u);
}

std::string zstd_of(const std::string& text) {
  std::string packed(ZSTD_compressBound(text.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), text.data(), text.size(), 3));
  return packed;
}

TEST(McapImport, UnpacksMessagesThatArePackedOneByOne) {
  const ScratchFolder scratch;
  std::string records = mcap_schema(1, kRos2Odometry) + mcap_channel(1, 1, "/odom");
  for (int i = 0; i < 100; ++i) {
    const double t_s = 1000.0 + 0.1 * i;
    std::string packed = zstd_of(ros2_odometry(t_s, 0.05 * i, 0.0, 0.0, 1.0));
    if (i == 40) packed.resize(packed.size() / 2);
    if (i == 50) packed[packed.size() / 2] ^= 0x55;
    records += mcap_message(1, t_s, packed);
  }
  write_file(scratch / "drive.mcap", kMcapBegin + records + kMcapEnd);
  const Outcome outcome = azimuth({"import", scratch / "drive.mcap", scratch / "run"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_GE(imported(scratch / "run").odometry.size(), 98u);
  EXPECT_NE(outcome.out.find("malformed messages"), std::string::npos) << outcome.out;
}

TEST(McapImport, MessagesThatUnpackToMoreThanARecordingDoesAreLeftOut) {
  const ScratchFolder scratch;
  std::string records = mcap_schema(1, kRos2Image) + mcap_channel(1, 1, "/cam") + mcap_schema(2, kRos2Odometry) +
                        mcap_channel(2, 2, "/odom");
  const std::string bomb = zstd_of(ros2_image(1000.0, 4000, 4000, "mono8", 4000, std::string(16'000'000, '\0')));
  for (int i = 0; i < 40; ++i) {
    records += mcap_message(1, 1000.0 + 0.1 * i, bomb);
    records += mcap_message(2, 1000.0 + 0.1 * i, ros2_odometry(1000.0 + 0.1 * i, 0.05 * i, 0.0, 0.0, 1.0));
  }
  write_file(scratch / "drive.mcap", kMcapBegin + records + kMcapEnd);
  const Outcome outcome = azimuth({"import", scratch / "drive.mcap", scratch / "run"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("malformed messages"), std::string::npos) << outcome.out;
  EXPECT_LT(imported(scratch / "run").frames.size(), 20u);
}

/// A drive straight ahead and then on a circle to the left. The messages have no orientation.
std::string unset_drive(bool with_twist) {
  std::string records = mcap_schema(1, kRos2Odometry) + mcap_channel(1, 1, "/odom");
  for (int i = 0; i < 100; ++i) {
    const double t_s = 1000.0 + 0.1 * i;
    const Ros2Speeds speeds = with_twist ? Ros2Speeds{0.5, i < 50 ? 0.0 : 0.5} : Ros2Speeds{};
    records += mcap_message(1, t_s, ros2_odometry(t_s, 0.05 * i, 0.0, 0.0, 0.0, "base", speeds));
  }
  return kMcapBegin + records + kMcapEnd;
}

TEST(McapImport, OdometryWithoutOrientationIsMadeFromItsSpeeds) {
  const ScratchFolder scratch;
  write_file(scratch / "drive.mcap", unset_drive(true));
  const Outcome outcome = azimuth({"import", scratch / "drive.mcap", scratch / "run"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("orientation is unset (a quaternion of zeros)"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("made from its twist"), std::string::npos) << outcome.out;
  const azimuth::Run run = imported(scratch / "run");
  ASSERT_EQ(run.odometry.size(), 100u);
  EXPECT_NEAR(run.odometry[49].T_odom_body.x_m, 2.45, 1e-6);
  EXPECT_NEAR(run.odometry[99].T_odom_body.heading_rad, 2.5, 1e-6);
  EXPECT_NEAR(run.odometry[99].T_odom_body.y_m, 1.0 - std::cos(2.5), 1e-6) << "a circle of one metre";
}

TEST(McapImport, OdometryWithoutOrientationAndSpeedsSaysSo) {
  const ScratchFolder scratch;
  write_file(scratch / "drive.mcap", unset_drive(false));
  const Outcome refused = azimuth({"import", scratch / "drive.mcap", scratch / "run"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("orientation is unset"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("JointState"), std::string::npos) << refused.err;
  EXPECT_FALSE(fs::exists(scratch / "run"));
}

TEST(McapImport, JointsThatAreNotTwoWheelsAreNamed) {
  const ScratchFolder scratch;
  std::string records = mcap_schema(1, kRos2JointState) + mcap_channel(1, 1, "/joint_states");
  for (int i = 0; i < 20; ++i)
    records += mcap_message(
        1, 1000.0 + 0.1 * i,
        ros2_joints(
            1000.0 + 0.1 * i,
            {{"front_left", 0.1 * i}, {"front_right", 0.1 * i}, {"rear_left", 0.1 * i}, {"rear_right", 0.1 * i}}));
  write_file(scratch / "drive.mcap", kMcapBegin + records + kMcapEnd);
  const std::vector<std::string> import{
      "import", scratch / "drive.mcap", scratch / "run", "--track", "0.4", "--wheel-radius", "0.1"};
  const Outcome refused = azimuth(import);
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("its joints are front_left, front_right, rear_left, rear_right: --joints LEFT,RIGHT"),
            std::string::npos)
      << refused.err;
  std::vector<std::string> named = import;
  named.insert(named.end(), {"--joints", "rear_left,rear_right"});
  ASSERT_EQ(azimuth(named).code, 0);
  EXPECT_NEAR(imported(scratch / "run").odometry.back().T_odom_body.x_m, 0.19, 1e-9);
}

TEST(McapImport, AClockThatWasSetBackCostsNothing) {
  const ScratchFolder scratch;
  std::string records = mcap_schema(1, kRos2Odometry) + mcap_channel(1, 1, "/odom") + mcap_schema(2, kRos2Image) +
                        mcap_channel(2, 2, "/cam");
  for (int i = 0; i < 200; ++i) {
    const double t_s = 9000.0 + 0.1 * i - (i < 80 ? 0.0 : 3600.0);
    records += mcap_message(1, t_s, ros2_odometry(t_s, 0.05 * i, 0.0, 0.0, 1.0));
    if (i % 10 == 5) records += mcap_message(2, t_s, ros2_image(t_s, 8, 6, "mono8", 8, std::string(48, 'x')));
  }
  write_file(scratch / "drive.mcap", kMcapBegin + records + kMcapEnd);
  const Outcome outcome = azimuth({"import", scratch / "drive.mcap", scratch / "run"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("the clock was set back 3600.0 s at 8.0 s"), std::string::npos) << outcome.out;
  const azimuth::Run run = imported(scratch / "run");
  EXPECT_EQ(run.odometry.size(), 200u);
  EXPECT_EQ(run.frames.size(), 20u);
  EXPECT_EQ(run.frames.back().stamp - run.odometry.front().stamp, Duration{19'500'000});
}

void make_database(const std::string& file, double begin_s) {
  DatabaseBag bag(file);
  bag.topic(1, "/odom", "nav_msgs/msg/Odometry");
  bag.topic(2, "/cam", "sensor_msgs/msg/Image");
  for (int i = 0; i < 100; ++i) {
    const double t_s = begin_s + 0.1 * i;
    bag.message(1, t_s, ros2_odometry(t_s, 0.05 * i, 0.0, 0.0, 1.0));
    if (i % 10 == 0) bag.message(2, t_s, zstd_of(ros2_image(t_s, 8, 6, "bgra8", 32, std::string(192, 'x'))));
  }
}

TEST(DatabaseImport, NeedsNoDefinitions) {
  const ScratchFolder scratch;
  make_database(scratch / "drive.db3", 1000.0);
  const Outcome listed = azimuth({"import", scratch / "drive.db3"});
  EXPECT_NE(listed.out.find("taken as images"), std::string::npos) << listed.out << listed.err;
  const Outcome outcome = azimuth({"import", scratch / "drive.db3", scratch / "run"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const azimuth::Run run = imported(scratch / "run");
  ASSERT_EQ(run.odometry.size(), 100u);
  EXPECT_NEAR(run.odometry[37].T_odom_body.x_m, 1.85, 1e-12);
  EXPECT_EQ(run.frames.size(), 10u);
}

TEST(DatabaseImport, TakesAFolderInPartsThatAreCompressed) {
  const ScratchFolder scratch;
  fs::create_directory(scratch / "bag");
  make_database(scratch / "a", 1000.0);
  make_database(scratch / "b", 1010.0);
  write_file(scratch / "bag/bag_0.db3.zstd", zstd_of(file_bytes(scratch / "a")));
  write_file(scratch / "bag/bag_1.db3.zstd", zstd_of(file_bytes(scratch / "b")));
  write_file(scratch / "bag/metadata.yaml",
             "  relative_file_paths:\n  - bag_0.db3.zstd\n  - bag_1.db3.zstd\n  compression_mode: FILE\n");
  const Outcome outcome = azimuth({"import", scratch / "bag", scratch / "run"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(imported(scratch / "run").odometry.size(), 200u);
  EXPECT_EQ(imported(scratch / "run").frames.size(), 20u);
  const std::string whole = zstd_of(file_bytes(scratch / "b"));
  write_file(scratch / "bag/bag_1.db3.zstd", whole.substr(0, whole.size() / 2));
  const Outcome cut = azimuth({"import", scratch / "bag", scratch / "other"});
  EXPECT_EQ(cut.code, 2);
  EXPECT_NE(cut.err.find("is compressed and cut short"), std::string::npos) << cut.err;
}

TEST(DatabaseImport, RefusesAFileThatUnpacksToMoreThanARecordingDoes) {
  const ScratchFolder scratch;
  write_file(scratch / "bomb.db3.zstd", zstd_of("SQLite format 3" + std::string(100'000'000, '\0')));
  const Outcome refused = azimuth({"import", scratch / "bomb.db3.zstd", scratch / "run"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("unpacks to more than"), std::string::npos) << refused.err;
}

TEST(McapImport, ListsWhatIsInIt) {
  const ScratchFolder scratch;
  write_file(scratch / "drive", recorded_drive());
  const Outcome listed = azimuth({"import", scratch / "drive"});
  EXPECT_EQ(listed.code, 0) << listed.err;
  for (const char* said : {"taken as odometry", "taken as images", "(json)"})
    EXPECT_NE(listed.out.find(said), std::string::npos) << said << " in " << listed.out;
}

TEST(McapImport, UsesWhatIsWholeOfARecordingThatIsCut) {
  const ScratchFolder scratch;
  const std::string whole = recorded_drive();
  write_file(scratch / "drive.mcap", whole.substr(0, whole.size() / 2));
  const Outcome outcome = azimuth({"import", scratch / "drive.mcap", scratch / "run"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("damaged bytes"), std::string::npos) << outcome.err;
  const std::size_t readings = imported(scratch / "run").odometry.size();
  EXPECT_GE(readings, 40u);
  EXPECT_LT(readings, 60u);
}

TEST(McapImport, RefusesWhatIsNone) {
  const ScratchFolder scratch;
  write_file(scratch / "drive.mcap", "t_s,x_m\n");
  const Outcome refused = azimuth({"import", scratch / "drive.mcap", scratch / "run"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("is not a bag"), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace azimuth::test
