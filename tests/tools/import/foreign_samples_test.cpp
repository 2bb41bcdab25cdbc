#include "tools/import/foreign_samples.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <string>

namespace azimuth::test {
namespace {

constexpr const char* kColumns = "t_s=time,x_m=px,y_m=py,heading_rad=yaw";

FileResult<std::vector<OdometryReading>> odometry(std::string_view text, const std::string& columns = kColumns,
                                                  const Wheels& wheels = {}) {
  std::uint64_t repeated = 0;
  return foreign_odometry({text, "odo.txt", columns, "--columns"}, wheels, repeated);
}

/// What is wrong with a table, one error a line.
std::string wrong(std::string_view table, const std::string& columns = kColumns, const Wheels& wheels = {}) {
  const auto read = odometry(table, columns, wheels);
  return read ? "" : text(read.error());
}

void expect_two_readings(const FileResult<std::vector<OdometryReading>>& read) {
  ASSERT_TRUE(read) << text(read.error());
  ASSERT_EQ(read->size(), 2u);
  EXPECT_EQ(read->at(1).stamp, stamp_from_us(1'500'000));
  EXPECT_EQ(read->at(1).T_odom_body, (Pose2{2.0, -3.0, 0.5}));
  EXPECT_EQ(read->at(1).sequence, 1u);
}

TEST(ForeignOdometry, FindsTheSeparatorByItself) {
  expect_two_readings(odometry("time,px,py,yaw\n1,0,0,0\n1.5,2,-3,0.5\n"));
  expect_two_readings(odometry("time;px;py;yaw\r\n1;0;0;0\r\n1.5;2;-3;0.5\r\n"));
  expect_two_readings(odometry("time\tpx\tpy\tyaw\n1\t0\t0\t0\n1.5\t2\t-3\t0.5\n"));
  expect_two_readings(odometry("time  px py yaw\n 1 0  0 0\n1.5   2 -3 0.5 \n"));
}

TEST(ForeignOdometry, TakesColumnsInAnyOrderAndPassesOthersOver) {
  expect_two_readings(odometry("yaw,gear,py,px,time\n0,P,0,0,1\n0.5,D,-3,2,1.5\n"));
  expect_two_readings(odometry("\"time\",\"px\",\"py\",\"yaw\"\n\"1\",\"0\",\"0\",\"0\"\n1.5, +2, -3, 0.5\n"));
}

TEST(ForeignOdometry, NeedsNoHeaderWhereColumnsAreNumbered) {
  constexpr const char* kNumbers = "t_s=1,x_m=2,y_m=3,heading_rad=4";
  expect_two_readings(odometry("1 0 0 0\n1.5 2 -3 0.5\n", kNumbers));
  expect_two_readings(odometry("# odometry\n#\n\n1 0 0 0\n# pause\n1.5 2 -3 0.5\n\n", kNumbers));
  expect_two_readings(odometry("a b c d\n1 0 0 0\n1.5 2 -3 0.5\n", kNumbers));
}

TEST(ForeignOdometry, TakesACommentForAHeaderWhenItFits) {
  expect_two_readings(odometry("# drive of May\n#time, px, py, yaw\n1,0,0,0\n1.5,2,-3,0.5\n"));
}

TEST(ForeignOdometry, ConvertsUnits) {
  const std::string degrees = std::to_string(0.5 * 180.0 / std::numbers::pi);
  const auto read = odometry("time,px,py,yaw\n1000000000,0,0,0\n1500000000,200,-3000,-" + degrees + "\n",
                             "t_s=time[ns],x_m=px[cm],y_m=py[mm],heading_rad=-yaw[deg]");
  ASSERT_TRUE(read) << text(read.error());
  EXPECT_EQ(read->at(1).stamp, stamp_from_us(1'500'000));
  EXPECT_NEAR(read->at(1).T_odom_body.x_m, 2.0, 1e-12);
  EXPECT_NEAR(read->at(1).T_odom_body.y_m, -3.0, 1e-12);
  EXPECT_NEAR(read->at(1).T_odom_body.heading_rad, 0.5, 1e-6);
}

TEST(ForeignOdometry, ReadsATrajectoryOfTum) {
  const auto read = odometry("# timestamp tx ty tz qx qy qz qw\n1 0 0 9 0 0 0 1\n1.5 2 -3 9 0 0 0.247404 0.968912\n",
                             "t_s=timestamp,x_m=tx,y_m=ty");
  ASSERT_TRUE(read) << text(read.error());
  EXPECT_NEAR(read->at(1).T_odom_body.heading_rad, 0.5, 1e-5);
  EXPECT_EQ(wrong("1 0 0 0 0 0.5 0.5\n", "t_s=1,x_m=2,y_m=3,qx=4,qy=5,qz=6,qw=7"),
            "odo.txt:1: qx, qy, qz, qw are no rotation: their squares must add up to 1\n");
}

TEST(ForeignOdometry, ReadsWheels) {
  const auto ticks = odometry("1,0,0\n2,1000,1000\n", "t_s=1,left_m=2[0.001],right_m=3[0.001]", {.track_m = 0.4});
  ASSERT_TRUE(ticks) << text(ticks.error());
  EXPECT_NEAR(ticks->at(1).T_odom_body.x_m, 1.0, 1e-12);
  const auto angles = odometry("1,0,0\n2,0,3.6\n", "t_s=1,left_rad=2,right_rad=3", {.radius_m = 0.1, .track_m = 0.4});
  ASSERT_TRUE(angles) << text(angles.error());
  EXPECT_NEAR(angles->at(1).T_odom_body.heading_rad, 0.9, 1e-12);
  EXPECT_NE(wrong("1,0,0\n", "t_s=1,left_m=2,right_m=3").find("--track METRES"), std::string::npos);
  EXPECT_NE(wrong("1,0,0\n", "t_s=1,left_rad=2,right_rad=3", {.track_m = 1}).find("--wheel-radius METRES"),
            std::string::npos);
}

TEST(ForeignOdometry, NamesLineAndColumnOfABadCell) {
  EXPECT_EQ(wrong("# c\ntime,px,py,yaw\n1,0,0,0\n\n2,soon,0,0\n"), "odo.txt:5: px \"soon\" is not a number\n");
  EXPECT_EQ(wrong("1 0 0 x\n", "t_s=1,x_m=2,y_m=3,heading_rad=4"), "odo.txt:1: column 4 \"x\" is not a number\n");
  EXPECT_EQ(wrong("time,px,py,yaw\n1,,0,0\n"), "odo.txt:2: px is empty\n");
  EXPECT_EQ(wrong("time,px,py,yaw\n1,0,0\n"), "odo.txt:2: expected 4 fields, found 3\n");
  EXPECT_EQ(wrong("time,px,py,yaw\nsoon,0,0,0\n"), "odo.txt:2: time \"soon\" is not a time in s, or out of range\n");
  EXPECT_EQ(wrong("time,px,py,yaw\n1,inf,0,0\n"), "odo.txt:2: px \"inf\" is not finite\n");
  EXPECT_EQ(wrong("time,px,py,yaw\n1,1e9,0,0\n"), "odo.txt:2: px \"1e9\" is out of range\n");
  EXPECT_EQ(wrong("time;px;py;yaw\n1;0,5;0;0\n"),
            "odo.txt:2: px \"0,5\" is not a number: a decimal comma? Numbers take a point\n");
  EXPECT_EQ(wrong("time,px,py,yaw\n2,0,0,0\n1,0,0,0\n"), "odo.txt:3: t_s is earlier than in the row above\n");
}

TEST(ForeignOdometry, NamesTheColumnsThereAreWhenOneIsMissing) {
  EXPECT_EQ(wrong("time,px,py,angle\n1,0,0,0\n"),
            "odo.txt:1: has no column \"yaw\"; there are time, px, py, angle: say which it is, such as "
            "--columns heading_rad=NAME\n");
  EXPECT_EQ(wrong("time,px,py,odom_yaw\n1,0,0,0\n", "t_s=time,x_m=px,y_m=py,heading_rad=odom.yaw"),
            "odo.txt:1: has no column \"odom.yaw\"; did you mean \"odom_yaw\"?\n");
  EXPECT_NE(wrong("1,0,0,0\n", "t_s=1,x_m=2,y_m=3,heading_rad=5").find("there are 4 without names"), std::string::npos);
  EXPECT_EQ(wrong("t_s,x_m,y_m,yaw\n1,0,0,0\n", ""),
            "odo.txt: nothing says which column is heading_rad (or qz and qw): --columns t_s=COLUMN,x_m=COLUMN,...; "
            "there are t_s, x_m, y_m, yaw\n");
}

TEST(ForeignOdometry, RefusesATableWithoutRows) {
  EXPECT_EQ(wrong(""), "odo.txt: has no rows\n");
  EXPECT_EQ(wrong("# nothing\n\n"), "odo.txt: has no rows\n");
  EXPECT_EQ(wrong("time,px,py,yaw\n"), "odo.txt: has no rows\n");
}

TEST(ForeignOdometry, LeavesOutRepeatedStampsAndCountsThem) {
  std::uint64_t repeated = 0;
  const auto read =
      foreign_odometry({"time,px,py,yaw\n1,0,0,0\n1,5,0,0\n2,1,0,0\n", "odo.txt", kColumns, "--columns"}, {}, repeated);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->size(), 2u);
  EXPECT_EQ(repeated, 1u);
}

TEST(ForeignOdometry, OfAMillionRowsNamesTheOneBadCell) {
  std::string table = "time,px,py,yaw\n";
  for (int i = 0; i < 1'000'000; ++i) {
    table += std::to_string(i);
    table += i == 700'000 ? ",1.0.0,2,0.5\n" : ",1.25,2,0.5\n";
  }
  EXPECT_EQ(wrong(table), "odo.txt:700002: px \"1.0.0\" is not a number\n");
}

TEST(ForeignBearings, OfOneStampAreOneImage) {
  const auto sets = foreign_bearings({"t;brg;id\n1;90;7\n1;-90;8\n2;350;7\n", "b.csv",
                                      "t_s=t,azimuth_rad=-brg[deg],landmark_id=id", "--bearings-columns"});
  ASSERT_TRUE(sets) << text(sets.error());
  ASSERT_EQ(sets->size(), 2u);
  ASSERT_EQ(sets->at(0).bearings.size(), 2u);
  EXPECT_NEAR(sets->at(0).bearings[0].azimuth_rad, -std::numbers::pi / 2, 1e-12) << "clockwise became the other way";
  EXPECT_EQ(sets->at(0).bearings[1].identity, 8);
  EXPECT_NEAR(sets->at(1).bearings[0].azimuth_rad, std::numbers::pi / 18, 1e-12);
  EXPECT_TRUE(std::isnan(sets->at(1).bearings[0].sigma_rad)) << "the rig knows it";
}

TEST(ForeignBearings, InDegreesAreAskedFor) {
  const auto sets = foreign_bearings({"t_s,brg\n1,148\n", "b.csv", "azimuth_rad=brg", "--bearings-columns"});
  ASSERT_FALSE(sets);
  EXPECT_EQ(text(sets.error()), "b.csv:2: brg \"148\" is out of range: in degrees? azimuth_rad=brg[deg] says so\n");
}

TEST(ForeignTruth, ReadsPosesOfAnotherProgram) {
  std::uint64_t repeated = 0;
  const auto truth =
      foreign_truth({"t,x,y,th\n1,2,3,0.5\n", "t.csv", "t_s=t,x_m=x,y_m=y,heading_rad=th", "-"}, repeated);
  ASSERT_TRUE(truth) << text(truth.error());
  EXPECT_EQ(truth->front().T_world_body, (Pose2{2, 3, 0.5}));
}

}  // namespace
}  // namespace azimuth::test
