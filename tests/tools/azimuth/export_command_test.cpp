#include <cmath>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sstream>

#include "drivers/storage/event_log.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/messages.hpp"
#include "tests/tools/azimuth/command_line.hpp"

namespace azimuth::test {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

std::vector<std::string> lines_of(const std::string& file) {
  std::vector<std::string> lines;
  std::istringstream stream(file_bytes(file));
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The numbers in one line of a CSV table or of a TUM file.
std::vector<double> numbers_of(std::string line) {
  for (char& letter : line) letter = letter == ',' ? ' ' : letter;
  std::vector<double> numbers;
  std::istringstream fields(line);
  for (double number = 0.0; fields >> number;) numbers.push_back(number);
  return numbers;
}

class ExportCommand : public testing::Test {
 protected:
  /// A log with the poses of ten steps, one second apart.
  std::string recorded_log(const std::string& prefix = "") {
    const std::string file = scratch_ / "drive.lcm";
    EventLogWriter log = *EventLogWriter::create(file);
    std::vector<std::byte> data;
    for (int i = 0; i < 10; ++i) {
      pose_cov_t pose{};
      pose.utime = 1'700'000'000'000'000 + 1'000'000 * i;
      pose.x_m = 0.5 * i;
      pose.health = pose_cov_t::HEALTH_TRACKING;
      encode(pose, data);
      EXPECT_FALSE(log.write(pose.utime, prefix + std::string(channel::kPose), data));
    }
    EXPECT_FALSE(log.flush());
    return file;
  }
  void expect_refused(const std::vector<std::string>& arguments, const std::string& sentence) {
    const Outcome outcome = azimuth(arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(sentence));
    EXPECT_EQ(outcome.out, "");
  }

  ScratchFolder scratch_;
};

TEST_F(ExportCommand, WritesWhatADaemonPublishedInEveryFormat) {
  std::vector<std::string> words{"export", recorded_log()};
  for (const char* name : {"a.tum", "a.kitti", "kitti_times:times.txt", "a.csv", "a.geojson", "a.bag", "a.mcap"}) {
    const std::string text = name;
    const std::size_t colon = text.find(':') + 1;  // 0: the word has no colon
    words.push_back(text.substr(0, colon) + (scratch_ / text.substr(colon)));
  }
  const Outcome outcome = azimuth(words);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("a.mcap: 10 poses, 0 landmarks\n"));
  EXPECT_EQ(lines_of(scratch_ / "a.tum").size(), 10u);
  EXPECT_EQ(lines_of(scratch_ / "a.kitti").size(), 10u);
  EXPECT_EQ(lines_of(scratch_ / "times.txt").at(9), "9.000000");
  EXPECT_THAT(lines_of(scratch_ / "a.csv").at(10), HasSubstr(",tracking,"));
  EXPECT_EQ(Json::parse(file_bytes(scratch_ / "a.geojson"))["features"].size(), 1u);
  EXPECT_THAT(file_bytes(scratch_ / "a.bag"), testing::StartsWith("#ROSBAG V2.0\n"));
  EXPECT_THAT(file_bytes(scratch_ / "a.mcap"), testing::StartsWith("\x89MCAP0"));
}

TEST_F(ExportCommand, OfItsBagIsImported) {
  ASSERT_EQ(azimuth({"export", recorded_log(), scratch_ / "a.bag"}).code, 0);
  const Outcome listed = azimuth({"import", scratch_ / "a.bag"});
  EXPECT_EQ(listed.code, 0) << listed.err;
  EXPECT_THAT(listed.out, HasSubstr("/odom"));
  EXPECT_THAT(listed.out, HasSubstr("taken as odometry"));
  const Outcome imported = azimuth({"import", scratch_ / "a.bag", scratch_ / "run", "--odometry", "/azimuth/pose"});
  ASSERT_EQ(imported.code, 0) << imported.err;
  EXPECT_EQ(numbers_of(lines_of(scratch_ / "run/odometry.csv").at(10)).at(1), 4.5);
}

TEST_F(ExportCommand, RefusesWhatHoldsNoPoses) {
  const std::string out = scratch_ / "a.csv";
  expect_refused({"export", one_lap(), out}, "holds what a robot sensed, and no poses; `azimuth replay " + one_lap());
  expect_refused({"export", recorded_log("R1_"), out}, "holds no pose on AZIMUTH_POSE (--prefix is for a daemon");
  expect_refused({"export", scratch_ / "nowhere", out}, "nowhere: is not there");
  write_file(scratch_ / "text.lcm", "text");
  expect_refused({"export", scratch_ / "text.lcm", out}, "is not an LCM log");
  EXPECT_EQ(azimuth({"export", recorded_log("R1_"), out, "--prefix", "R1_"}).code, 0);
}

TEST_F(ExportCommand, RefusesANameThatSaysNoFormat) {
  expect_refused({"export", recorded_log(), scratch_ / "poses.txt"},
                 "its ending is no format to export to: tum, kitti, kitti_times, csv, geojson, bag or mcap");
  expect_refused({"replay", one_lap(), "--export", scratch_ / "poses.txt"}, "such as kitti:poses.txt");
}

TEST_F(ExportCommand, FailsBeforeTheRunWhereNothingCanBeWritten) {
  const Outcome outcome = azimuth({"replay", one_lap(), "--export", scratch_ / "no/such/folder/a.bag"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("cannot be written"));
  EXPECT_EQ(outcome.out, "");
}

TEST_F(ExportCommand, TakesAnOriginForGeoJsonAlone) {
  const std::string log = recorded_log();
  expect_refused({"export", log, scratch_ / "a.bag", "--origin", "48,9"}, "only GeoJSON has a place on the globe");
  expect_refused({"export", log, scratch_ / "a.geojson", "--origin", "148,9"}, "must be LAT,LON[,HEADING]");
  ASSERT_EQ(azimuth({"export", log, scratch_ / "a.geojson", "--origin", "48,9"}).code, 0);
  EXPECT_FALSE(Json::parse(file_bytes(scratch_ / "a.geojson")).contains("crs"));
  EXPECT_THAT(azimuth({"export", log, scratch_ / "a.geojson"}).err,
              HasSubstr("--origin LAT,LON puts them on the globe"));
}

TEST_F(ExportCommand, OfAReplayIsTheTrajectoryOfTheReplay) {
  const std::string tum = scratch_ / "a.tum", csv = scratch_ / "a.csv";
  const Outcome outcome = azimuth({"replay", one_lap(), "--quiet", "--tum", tum, "--export", csv, "--export",
                                   scratch_ / "a.mcap", "--export", scratch_ / "a.geojson"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out + outcome.err, "") << "it is quiet";
  const auto poses = lines_of(tum), rows = lines_of(csv);
  ASSERT_EQ(rows.size(), poses.size() + 1);
  for (std::size_t i = 0; i < poses.size(); i += 10) {
    const auto pose = numbers_of(poses[i]), row = numbers_of(rows[i + 1]);
    EXPECT_EQ(row.at(0), pose.at(0));
    EXPECT_EQ(row.at(1), pose.at(1));
    EXPECT_EQ(row.at(2), pose.at(2));
    EXPECT_GT(row.at(4), -1e-12) << "a variance";
  }
  EXPECT_THAT(rows.back(), HasSubstr(",tracking,"));
  EXPECT_THAT(file_bytes(scratch_ / "a.mcap"), HasSubstr("visualization_msgs/msg/MarkerArray"));
}

TEST_F(ExportCommand, OfARefinedRunIsTheRefinedTrajectory) {
  const std::string tum = scratch_ / "a.tum", csv = scratch_ / "a.csv", then = scratch_ / "then.csv";
  ASSERT_EQ(azimuth({"replay", one_lap(), "--quiet", "--export", then}).code, 0);
  const Outcome outcome = azimuth({"map", "refine", one_lap(), "--quiet", "--tum", tum, "--export", csv});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto poses = lines_of(tum), rows = lines_of(csv);
  ASSERT_EQ(rows.size(), poses.size() + 1);
  const auto pose = numbers_of(poses[20]), row = numbers_of(rows[21]);
  EXPECT_EQ(row.at(1), pose.at(1));
  EXPECT_EQ(row.size(), 13u) << "with odometry, without a health";
  EXPECT_NE(numbers_of(lines_of(then).at(21)).at(1), row.at(1)) << "it was known less well then";
}

TEST_F(ExportCommand, OfSeveralRunsIsRefused) {
  expect_refused({"replay", one_lap(), one_lap(), "--export", scratch_ / "a.csv"}, "take the outcome of one RUN only");
}

}  // namespace
}  // namespace azimuth::test
