#include <algorithm>
#include <gtest/gtest.h>

#include "drivers/storage/event_log.hpp"
#include "drivers/wire/messages.hpp"
#include "tests/support/places.hpp"
#include "tests/tools/azimuth/command_line.hpp"

namespace azimuth::test {
namespace {

TEST(ConvertCommand, ThereAndBackKeepsEveryBit) {
  const ScratchFolder scratch;
  const std::string log = scratch / "lab.lcmlog", folder = scratch / "lab";
  ASSERT_EQ(azimuth({"import", test::one_lap(), log}).code, 0);
  ASSERT_EQ(azimuth({"import", log, folder}).code, 0);
  EXPECT_EQ(folder_bytes(folder), folder_bytes(test::one_lap()));

  const std::string exported = scratch / "exported.lcmlog";
  ASSERT_EQ(azimuth({"export", test::one_lap(), exported}).code, 0);
  EXPECT_EQ(file_bytes(exported), file_bytes(log));
  EXPECT_EQ(azimuth({"export", test::one_lap(), exported}).code, 2) << "it is there already";
  EXPECT_EQ(azimuth({"export", test::one_lap(), exported, "--force"}).code, 0);

  const std::string digest = digest_of(test::one_lap());
  EXPECT_EQ(digest.size(), 16u) << digest;
  EXPECT_EQ(digest_of(log), digest);
  EXPECT_EQ(digest_of(folder), digest);
}

TEST(ConvertCommand, OverwritesOnlyWhenForced) {
  const ScratchFolder scratch;
  const std::string log = scratch / "lab.lcmlog";
  write_file(log, "precious");
  const Outcome refused = azimuth({"import", test::one_lap(), log});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--force"), std::string::npos);
  EXPECT_EQ(file_bytes(log), "precious");
  EXPECT_EQ(azimuth({"import", test::one_lap(), log, "--force"}).code, 0);
  EXPECT_GT(file_bytes(log).size(), 1000u);
}

TEST(ConvertCommand, RefusesANameOfTheOtherKind) {
  const ScratchFolder scratch;
  std::filesystem::create_directory(scratch / "folder.lcmlog");
  write_file(scratch / "file", "precious");
  EXPECT_EQ(azimuth({"import", test::one_lap(), scratch / "folder.lcmlog", "--force"}).code, 2);
  EXPECT_EQ(azimuth({"import", test::one_lap(), scratch / "file", "--force"}).code, 2);
  EXPECT_EQ(file_bytes(scratch / "file"), "precious");
}

TEST(ConvertCommand, RefusesItsOwnInput) {
  const ScratchFolder scratch;
  const std::string run = scratch / "run";
  ASSERT_EQ(azimuth({"simulate", run, "--world", "coloured-lab"}).code, 0);
  const auto before = folder_bytes(run);
  EXPECT_EQ(azimuth({"import", run, run, "--force"}).code, 2);
  EXPECT_EQ(folder_bytes(run), before);
}

/// Writes the log of another program: it holds only odometry, as bot_core poses.
void write_foreign_log(const std::string& file) {
  EventLogWriter log = *EventLogWriter::create(file);
  std::vector<std::byte> data;
  for (int i = 0; i < 20; ++i) {
    pose_t pose{};
    pose.utime = 100'000 * i;
    pose.pos[0] = 0.05 * i;
    pose.orientation[0] = 1.0;
    encode(pose, data);
    ASSERT_FALSE(log.write(pose.utime, "WHEELS", data));
  }
}

TEST(ConvertCommand, TakesOdometryOfOthersWithoutAnyBearing) {
  const ScratchFolder scratch;
  const std::string log = scratch / "foreign.lcm", folder = scratch / "run", rig = test::one_lap() + "/rig.toml";
  write_foreign_log(log);
  const Outcome rigless = azimuth({"import", log, folder, "--odometry-channel", "WHEELS"});
  EXPECT_EQ(rigless.code, 0) << "a rig may come later: " << rigless.err;
  EXPECT_NE(rigless.out.find("no rig yet; next: azimuth calibrate " + folder + " --out " + folder + "/rig.toml"),
            std::string::npos)
      << rigless.out;
  EXPECT_FALSE(std::filesystem::exists(folder + "/rig.toml"));
  const Outcome no_log = azimuth({"import", log, scratch / "copy.lcm", "--odometry-channel", "WHEELS"});
  EXPECT_EQ(no_log.code, 2) << "to a folder only";
  EXPECT_NE(no_log.err.find("give it with --rig FILE"), std::string::npos) << no_log.err;
  std::filesystem::remove_all(folder);
  const Outcome not_told = azimuth({"import", log, folder, "--rig", rig});
  EXPECT_EQ(not_told.code, 2) << "AZIMUTH_ODOM is not in it";
  EXPECT_NE(not_told.err.find("; perhaps --odometry-channel WHEELS\n"), std::string::npos) << not_told.err;

  const Outcome converted = azimuth({"import", log, folder, "--odometry-channel", "WHEELS", "--rig", rig});
  ASSERT_EQ(converted.code, 0) << converted.err;
  EXPECT_EQ(file_bytes(folder + "/rig.toml"), file_bytes(rig));
  const std::string table = file_bytes(folder + "/odometry.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 21);
  EXPECT_FALSE(std::filesystem::exists(folder + "/bearings.csv"));
  const std::string back = scratch / "back.lcm";
  EXPECT_EQ(azimuth({"import", folder, back}).code, 0);
  EXPECT_EQ(azimuth({"replay", back}).code, 2) << "there is nothing to estimate from";
}

TEST(ConvertCommand, LeavesNothingBehindForABadInput) {
  const ScratchFolder scratch;
  EXPECT_EQ(azimuth({"import", scratch / "nowhere", scratch / "out"}).code, 2);
  EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
}

}  // namespace
}  // namespace azimuth::test
