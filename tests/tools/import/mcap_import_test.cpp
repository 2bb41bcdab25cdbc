// azimuth import of MCAP.

#include <gtest/gtest.h>

#include "drivers/storage/run.hpp"
#include "tests/support/places.hpp"
#include "tests/tools/azimuth/command_line.hpp"
#include "tests/tools/import/ros2_messages.hpp"

namespace azimuth::test {
namespace {

namespace fs = std::filesystem;

/// 10 s of odometry at 10 Hz, an image a second, and what nobody asks for.
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

TEST(McapImport, TakesTheFolderAroundIt) {
  const ScratchFolder scratch;
  fs::create_directory(scratch / "bag");
  write_file(scratch / "bag/metadata.yaml", "rosbag2_bagfile_information:\n");
  write_file(scratch / "bag/bag_0.mcap", recorded_drive());
  EXPECT_EQ(azimuth({"import", scratch / "bag", scratch / "run"}).code, 0);
  write_file(scratch / "bag/bag_1.mcap", recorded_drive());
  const Outcome refused = azimuth({"import", scratch / "bag", scratch / "other"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("holds 2 MCAP files"), std::string::npos) << refused.err;
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
