#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>
#include <sstream>

#include "tests/support/places.hpp"
#include "tests/tools/azimuth/command_line.hpp"

namespace azimuth::test {
namespace {

namespace fs = std::filesystem;

/// The odometry of the lap with other column names, in milliseconds and millimetres, separated by blanks.
std::string foreign_odometry_of_the_lap() {
  std::istringstream lap(file_bytes(one_lap() + "/odometry.csv"));
  std::string line, table = "# wheel odometry\n# stamp px py yaw\n";
  std::getline(lap, line);
  for (double t = 0, x = 0, y = 0, heading = 0; std::getline(lap, line);) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream(line) >> t >> x >> y >> heading;
    std::ostringstream row;
    row.precision(17);
    row << 1000 * t << ' ' << 1000 * x << ' ' << 1000 * y << ' ' << heading << '\n';
    table += row.str();
  }
  return table;
}

constexpr const char* kForeignColumns = "t_s=stamp[ms],x_m=px[mm],y_m=py[mm],heading_rad=yaw";

TEST(ImportCommand, ThreeTablesGiveTheRunTheyCameFrom) {
  const ScratchFolder scratch;
  const std::string lap = one_lap(), out = scratch / "run";
  const Outcome imported = azimuth({"import", lap + "/odometry.csv", out, "--bearings", lap + "/bearings.csv",
                                    "--truth", lap + "/truth.csv", "--rig", lap + "/rig.toml"});
  ASSERT_EQ(imported.code, 0) << imported.err;
  EXPECT_EQ(imported.err, "");
  for (const char* name : {"/odometry.csv", "/bearings.csv", "/truth.csv", "/rig.toml"})
    EXPECT_EQ(file_bytes(out + name), file_bytes(lap + name)) << name;
  EXPECT_NE(imported.out.find("next: azimuth replay " + out + " --plot map.png"), std::string::npos) << imported.out;
  EXPECT_EQ(digest_of(out), digest_of(lap));
}

TEST(ImportCommand, AMapTakesTwoCommandsFromTablesOfOthers) {
  const ScratchFolder scratch;
  const std::string out = scratch / "run", table = scratch / "odometry.txt", bearings = scratch / "seen.csv";
  write_file(table, foreign_odometry_of_the_lap());
  std::string seen = file_bytes(one_lap() + "/bearings.csv");
  seen.replace(0, seen.find('\n'), "time,direction,tag");
  write_file(bearings, seen);
  const Outcome imported =
      azimuth({"import", table, out, "--columns", kForeignColumns, "--bearings", bearings, "--bearings-columns",
               "t_s=time,azimuth_rad=direction,landmark_id=tag", "--rig", one_lap() + "/rig.toml"});
  ASSERT_EQ(imported.code, 0) << imported.err;
  const std::string map = scratch / "map.png";
  const Outcome replayed = azimuth({"replay", out, "--plot", map});
  EXPECT_EQ(replayed.code, 0) << replayed.err;
  EXPECT_GT(file_bytes(map).size(), 1000u);
}

TEST(ImportCommand, MakesALogAsWell) {
  const ScratchFolder scratch;
  const std::string lap = one_lap(), log = scratch / "run.lcmlog";
  const Outcome rigless = azimuth({"import", lap + "/odometry.csv", log, "--bearings", lap + "/bearings.csv"});
  EXPECT_EQ(rigless.code, 2);
  EXPECT_NE(rigless.err.find("a log holds its rig: give it with --rig FILE"), std::string::npos) << rigless.err;
  ASSERT_EQ(
      azimuth({"import", lap + "/odometry.csv", log, "--bearings", lap + "/bearings.csv", "--rig", lap + "/rig.toml"})
          .code,
      0);
  EXPECT_EQ(digest_of(log), digest_of(lap));
}

TEST(ImportCommand, NamesEveryBadCellOfEveryTable) {
  const ScratchFolder scratch;
  write_file(scratch / "o.txt", "t,x,y,h\n0,0,0,0\n1,zero,0,0\n");
  write_file(scratch / "b.txt", "t,a\n0,200\n");
  const Outcome refused =
      azimuth({"import", scratch / "o.txt", scratch / "run", "--columns", "t_s=t,x_m=x,y_m=y,heading_rad=h",
               "--bearings", scratch / "b.txt", "--bearings-columns", "t_s=t,azimuth_rad=a"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.err, (scratch / "o.txt") + ":3: x \"zero\" is not a number\n" + (scratch / "b.txt") +
                             ":2: a \"200\" is out of range: in degrees? azimuth_rad=a[deg] says so\n");
  EXPECT_FALSE(fs::exists(scratch / "run"));
}

TEST(ImportCommand, RefusesAMillionRowsForOneBadCellAtOnce) {
  const ScratchFolder scratch;
  std::string table = "t_s,x_m,y_m,heading_rad\n";
  for (int i = 0; i < 1'000'000; ++i) table += std::to_string(i) + (i == 999'999 ? ",1,2,left\n" : ",1,2,3\n");
  write_file(scratch / "o.csv", table);
  const auto begin = std::chrono::steady_clock::now();
  const Outcome refused = azimuth({"import", scratch / "o.csv", scratch / "run"});
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.err, (scratch / "o.csv") + ":1000001: heading_rad \"left\" is not a number\n");
  EXPECT_LT(took.count(), 20.0) << "a second is what it takes";
}

TEST(ImportCommand, BringsImagesAndSaysWhatComesNext) {
  const ScratchFolder scratch;
  const std::string out = scratch / "run", odometry = scratch / "o.csv";
  write_file(odometry, "t_s,x_m,y_m,heading_rad\n0,0,0,0\n1,0.5,0,0\n2,1,0,0\n");
  fs::create_directory(scratch / "images");
  write_file(scratch / "images/0500.jpg", "\xff\xd8\xff\xe0 one");
  write_file(scratch / "images/1500.jpg", "\xff\xd8\xff\xe0 two");
  const Outcome imported = azimuth({"import", odometry, out, "--images", scratch / "images", "--stamps", "name[ms]"});
  ASSERT_EQ(imported.code, 0) << imported.err;
  EXPECT_EQ(file_bytes(out + "/frames.csv"), "t_s,file\n0.500000,frames/000000.jpg\n1.500000,frames/000001.jpg\n");
  EXPECT_EQ(file_bytes(out + "/frames/000001.jpg"), "\xff\xd8\xff\xe0 two");
  EXPECT_FALSE(fs::exists(out + "/rig.toml"));
  EXPECT_NE(imported.out.find("azimuth calibrate " + out), std::string::npos) << imported.out;
  // A second import keeps the rig.toml that a calibration has written in the meantime.
  fs::copy_file(one_lap() + "/rig.toml", out + "/rig.toml");
  ASSERT_EQ(azimuth({"import", odometry, out, "--images", scratch / "images", "--stamps", "name[ms]", "--force"}).code,
            0);
  EXPECT_EQ(file_bytes(out + "/rig.toml"), file_bytes(one_lap() + "/rig.toml"));
}

TEST(ImportCommand, SaysWhenClocksHaveNothingInCommon) {
  const ScratchFolder scratch;
  write_file(scratch / "o.csv", "t_s,x_m,y_m,heading_rad\n0,0,0,0\n1,1,0,0\n");
  write_file(scratch / "b.csv", "t_s,azimuth_rad\n5000,1\n");
  const Outcome imported = azimuth({"import", scratch / "o.csv", scratch / "run", "--bearings", scratch / "b.csv"});
  EXPECT_EQ(imported.code, 0) << imported.err;
  EXPECT_NE(imported.err.find("bearings are not of the odometry's time (odometry 0 to 1 s, bearings 5000 to 5000 s)"),
            std::string::npos)
      << imported.err;
}

TEST(ImportCommand, LeavesItsInputsAlone) {
  const ScratchFolder scratch;
  const std::string run = scratch / "run";
  fs::copy(one_lap(), run, fs::copy_options::recursive);
  const auto before = folder_bytes(run);
  EXPECT_EQ(azimuth({"import", run + "/odometry.csv", run}).code, 2) << "it is there already";
  const Outcome refused = azimuth({"import", run + "/odometry.csv", run, "--force"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("is what would be written"), std::string::npos) << refused.err;
  EXPECT_EQ(folder_bytes(run), before);
}

TEST(ImportCommand, RefusesARigWithMistakesBeforeItWrites) {
  const ScratchFolder scratch;
  write_file(scratch / "rig.toml", "[camera]\nsigma_bearing_deg = 1\n");
  const Outcome refused =
      azimuth({"import", one_lap() + "/odometry.csv", scratch / "run", "--rig", scratch / "rig.toml"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("sigma_bearing_deg"), std::string::npos) << refused.err;
  EXPECT_FALSE(fs::exists(scratch / "run"));
}

TEST(ImportCommand, SaysWhatReadsWhatItDoesNot) {
  const ScratchFolder scratch;
  for (const auto& [begin, answer] : std::vector<std::pair<std::string, std::string>>{
           {"\x1F\x8B\x08", "is compressed by gzip: gunzip it first"},
           {"\x28\xB5\x2F\xFD", "is compressed by zstd: unzstd it first"},
           {"version https://git-lfs.github.com/spec/v1\n", "git lfs pull"}}) {
    write_file(scratch / "odometry.csv", begin + std::string(40, 'x'));
    const Outcome refused = azimuth({"import", scratch / "odometry.csv", scratch / "run"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find(answer), std::string::npos) << refused.err;
    EXPECT_FALSE(fs::exists(scratch / "run"));
  }
}

TEST(ImportCommand, TablesAndRigsThatArePackedSaySo) {
  const ScratchFolder scratch;
  write_file(scratch / "packed", "\x1F\x8B\x08 and so on");
  for (const char* option : {"--rig", "--bearings", "--truth"}) {
    const Outcome refused =
        azimuth({"import", one_lap() + "/odometry.csv", scratch / "run", option, scratch / "packed"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("packed: is compressed by gzip"), std::string::npos) << refused.err;
  }
}

TEST(ImportCommand, BagsThatAreReplayedSayThatTheyAreImportedFirst) {
  const ScratchFolder scratch;
  fs::create_directory(scratch / "bag");
  write_file(scratch / "bag/metadata.yaml", "rosbag2_bagfile_information:\n");
  write_file(scratch / "a.mcap", "\x89MCAP0\r\n");
  write_file(scratch / "a.bag", "#ROSBAG V2.0\n");
  write_file(scratch / "a.db3", std::string("SQLite format 3\0", 16));
  for (const char* name : {"bag", "a.mcap", "a.bag", "a.db3"}) {
    const Outcome refused = azimuth({"replay", scratch / name});
    EXPECT_EQ(refused.code, 2) << name;
    EXPECT_NE(refused.err.find("azimuth import makes a run of it"), std::string::npos) << refused.err;
  }
}

TEST(ImportCommand, RefusesColumnsOfATableThatIsNotGiven) {
  const ScratchFolder scratch;
  const std::string odometry = one_lap() + "/odometry.csv";
  EXPECT_EQ(azimuth({"import", odometry, scratch / "run", "--bearings-columns", "t_s=t"}).code, 2);
  EXPECT_EQ(azimuth({"import", odometry}).code, 2);
  EXPECT_EQ(azimuth({"import", scratch / "nowhere", scratch / "run"}).code, 2);
  EXPECT_FALSE(fs::exists(scratch / "run"));
}

}  // namespace
}  // namespace azimuth::test
