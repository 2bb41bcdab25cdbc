#include "tools/import/foreign_samples.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <string>

#include "tools/import/foreign_table.hpp"

namespace azimuth::test {
namespace {

constexpr const char* kColumns = "t_s=time,x_m=px,y_m=py,heading_rad=yaw";

FileResult<std::vector<BearingSet>> bearings(const ForeignText& table) {
  TableNotes notes;
  return foreign_bearings(table, notes);
}

FileResult<std::vector<OdometryReading>> odometry(std::string_view text, const std::string& columns = kColumns,
                                                  const Wheels& wheels = {}) {
  TableNotes notes;
  return foreign_odometry({text, "odo.txt", columns, "--columns"}, wheels, notes);
}

/// The errors of a table, one per line.
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
  TableNotes notes;
  const auto read =
      foreign_odometry({"time,px,py,yaw\n1,0,0,0\n1,5,0,0\n2,1,0,0\n", "odo.txt", kColumns, "--columns"}, {}, notes);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->size(), 2u);
  EXPECT_EQ(notes.repeated, 1u);
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
  const auto sets = bearings({"t;brg;id\n1;90;7\n1;-90;8\n2;350;7\n", "b.csv",
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
  const auto sets = bearings({"t_s,brg\n1,148\n", "b.csv", "azimuth_rad=brg", "--bearings-columns"});
  ASSERT_FALSE(sets);
  EXPECT_EQ(text(sets.error()), "b.csv:2: brg \"148\" is out of range: in degrees? azimuth_rad=brg[deg] says so\n");
}

/// Five images per second, each of three landmarks. The first column has `stamp(image)`, the second one the nanoseconds
/// within the second.
std::string bearings_of(std::string (*stamp)(int), int images) {
  std::string table = "t,nsec,brg,id\n";
  for (int i = 0; i < images; ++i)
    for (int id = 0; id < 3; ++id)
      table += stamp(i) + ',' + std::to_string(i % 5 * 200'000'000) + ',' + std::to_string(id - 0.01 * i) + ',' +
               std::to_string(id) + '\n';
  return table;
}

TEST(ForeignBearings, InWholeSecondsAreRefusedWithTheColumnThatIsFiner) {
  const std::string table = bearings_of([](int i) { return std::to_string(i / 5); }, 50);
  const ForeignText coarse{table, "b.csv", "t_s=t,azimuth_rad=brg,landmark_id=id", "--bearings-columns"};
  const auto sets = bearings(coarse);
  ASSERT_FALSE(sets);
  EXPECT_EQ(
      text(sets.error()),
      "b.csv: 10 of 10 images show a landmark more than once, up to 5 times: rows of one t_s are of one image, and "
      "these are in whole seconds; column nsec goes on within them: --bearings-columns t_s=t+nsec\n");
  const auto fine = bearings({table, "b.csv", "t_s=t+nsec,azimuth_rad=brg,landmark_id=id", "--bearings-columns"});
  ASSERT_TRUE(fine) << text(fine.error());
  EXPECT_EQ(fine->size(), 50u);
  EXPECT_EQ(fine->at(7).stamp, stamp_from_us(1'400'000));
}

TEST(ForeignBearings, ThatRepeatANameAreNoted) {
  TableNotes notes;
  const auto sets = foreign_bearings(
      {"t_s,azimuth_rad,landmark_id\n0.5,0,7\n0.5,1,7\n1.5,0,7\n1.5,0.5,\n", "b.csv", "", "--bearings-columns"}, notes);
  ASSERT_TRUE(sets) << text(sets.error());
  EXPECT_EQ(sets->at(1).bearings.at(1).identity, kUnknownIdentity) << "an empty name is none";
  ASSERT_EQ(notes.sentences.size(), 2u);
  EXPECT_NE(notes.sentences[0].find("1 of 4 bearings have no landmark_id: camera.identities = true"),
            std::string::npos);
  EXPECT_NE(notes.sentences[1].find("1 of 2 images show a landmark more than once"), std::string::npos);
}

TEST(ForeignOdometry, InWholeSecondsIsRefusedWithTheColumnThatIsFiner) {
  std::string table;
  for (int i = 0; i < 50; ++i)
    table += std::to_string(1'700'000'000 + i / 10) + ',' + std::to_string(i % 10 * 100'000'000) + ",odom," +
             std::to_string(0.03 * i) + ",0,0,1\n";
  const std::string columns = "t_s=1,x_m=4,y_m=5,qz=6,qw=7";
  EXPECT_EQ(
      wrong(table, columns),
      "odo.txt: 45 of 50 rows have the stamp of the row above and other values: stamps in whole seconds, perhaps; "
      "column 2 goes on within them: --columns t_s=1+2\n");
  const auto read = odometry(table, "t_s=1+2,x_m=4,y_m=5,qz=6,qw=7");
  ASSERT_TRUE(read) << text(read.error());
  ASSERT_EQ(read->size(), 50u);
  EXPECT_EQ(read->at(23).stamp, stamp_from_us(1'700'000'002'300'000));
}

TEST(ForeignOdometry, TakesStampsInTwoColumnsAndOtherUnits) {
  const auto micros = odometry("s us x y h\n10 0 0 0 0\n10 500000 1 0 0\n", "t_s=s+us[us],x_m=x,y_m=y,heading_rad=h");
  ASSERT_TRUE(micros) << text(micros.error());
  EXPECT_EQ(micros->at(1).stamp, stamp_from_us(10'500'000));
  EXPECT_EQ(wrong("s us x y h\n10 0 0 0 0\n10.5 5 1 0 0\n", "t_s=s+us[us],x_m=x,y_m=y,heading_rad=h"),
            "odo.txt:3: columns s and us: \"10.5\" and \"5\" are not whole seconds and what is beyond them\n");
  EXPECT_NE(wrong("s x y h\n10 0 0 0\n", "t_s=s+nsec,x_m=x,y_m=y,heading_rad=h").find("has no column \"nsec\""),
            std::string::npos);
  EXPECT_NE(wrong("1 0 0 0\n", "t_s=1+").find("must have the form t_s=SECONDS+NANOSECONDS"), std::string::npos);
}

TEST(ForeignOdometry, TakesDatesForStamps) {
  constexpr std::int64_t kMay_us = 1'777'638'600'250'000;
  for (const std::string date : {"2026-05-01T12:30:00.250Z", "2026-05-01 12:30:00.250", "2026-05-01T14:30:00,25+02:00",
                                 "2026-05-01T05:00:00.25-0730"}) {
    const auto read = odometry("time;px;py;yaw\n" + date + ";1;2;0.5\n");
    ASSERT_TRUE(read) << text(read.error());
    EXPECT_EQ(read->front().stamp, stamp_from_us(kMay_us)) << date;
  }
  const auto parted =
      odometry("date time px py yaw\n2026-05-01 12:30:00.25 1 2 0.5\n", "t_s=date+time,x_m=px,y_m=py,heading_rad=yaw");
  ASSERT_TRUE(parted) << text(parted.error());
  EXPECT_EQ(parted->front().stamp, stamp_from_us(kMay_us));
  for (const std::string date :
       {"2026-13-01T12:30:00Z", "2026-02-30T12:30:00", "2026-05-01", "2026-05-01T25:00", "2026-05-01T12:30:99"})
    EXPECT_NE(wrong("time;px;py;yaw\n" + date + ";1;2;0.5\n").find("is not a time"), std::string::npos) << date;
}

TEST(ForeignOdometry, TakesUnitsFromTheHeader) {
  const auto read = odometry(
      "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [mm],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z []\n"
      "1403636579758555392,1,2000,1,0,0,0\n1403636579858555392,1.1,2000,1,0,0,0\n",
      "t_s=timestamp,x_m=p_RS_R_x,y_m=p_RS_R_y,qw=q_RS_w,qx=q_RS_x,qy=q_RS_y,qz=q_RS_z");
  ASSERT_TRUE(read) << text(read.error());
  EXPECT_EQ(read->at(0).stamp, stamp_from_us(1'403'636'579'758'555));
  EXPECT_NEAR(read->at(0).T_odom_body.y_m, 2.0, 1e-12);
  const auto told = odometry("time [s],px,py,yaw\n1500,1,2,0\n", "t_s=time[ms],x_m=px,y_m=py,heading_rad=yaw");
  ASSERT_TRUE(told);
  EXPECT_EQ(told->at(0).stamp, stamp_from_us(1'500'000)) << "what was said goes before what stands there";
}

TEST(ForeignOdometry, TakesTheSeparatorThatASpreadsheetNames) {
  expect_two_readings(odometry("sep=;\r\ntime;px;py;yaw\r\n1;0;0;0\r\n1.5;2;-3;0.5\r\n"));
  expect_two_readings(odometry("sep=|\ntime|px|py|yaw\n1|0|0|0\n1.5|2|-3|0.5\n"));
  EXPECT_EQ(wrong("sep=;\ntime;px;py;yaw\n1;x;0;0\n"), "odo.txt:3: px \"x\" is not a number\n");
}

TEST(ForeignOdometry, OfUtf16IsText) {
  const std::string_view table = "time\tpx\tpy\tyaw\n1\t0\t0\t0\n1.5\t2\t-3\t0.5\n";
  std::string little = "\xFF\xFE", big = "\xFE\xFF";
  for (const char letter : table) {
    little += {letter, '\0'};
    big += {'\0', letter};
  }
  expect_two_readings(odometry(in_utf8(little)));
  expect_two_readings(odometry(in_utf8(big)));
  EXPECT_EQ(in_utf8(std::string(table)), table);
  EXPECT_EQ(in_utf8(std::string("\xFF\xFE\xE4\x00\xAC\x20", 6)), "\xC3\xA4\xE2\x82\xAC");
}

TEST(ForeignOdometry, AddsUpSpeeds) {
  std::string table = "t v w\n";
  for (int i = 0; i <= 100; ++i) table += std::to_string(0.1 * i) + " 1.8 30\n";
  const auto read = odometry(table, "t_s=t,speed_m_s=v[km/h],turn_rad_s=-w[deg/s]");
  ASSERT_TRUE(read) << text(read.error());
  const double turned_rad = -10.0 * std::numbers::pi / 6.0, radius_m = 0.5 / (std::numbers::pi / 6.0);
  const Pose2 end = read->back().T_odom_body;
  EXPECT_NEAR(end.x_m, -radius_m * std::sin(turned_rad), 1e-6);
  EXPECT_NEAR(end.y_m, -radius_m * (1.0 - std::cos(turned_rad)), 1e-6);
  EXPECT_NEAR(end.heading_rad, wrap(turned_rad), 1e-6);
  EXPECT_EQ(read->back().sigma_gap_m, 0.0);
  const auto sparse = odometry("t v w\n0 1 0\n2 1 0\n", "t_s=t,speed_m_s=v,turn_rad_s=w");
  ASSERT_TRUE(sparse);
  EXPECT_NEAR(sparse->back().T_odom_body.x_m, 2.0, 1e-12);
  EXPECT_NEAR(sparse->back().sigma_gap_m, 1.0, 1e-12) << "nobody knows how it went for two seconds";
}

TEST(ForeignOdometry, ThatBeginsAnewIsParted) {
  std::string table = "t_s,x_m,y_m,heading_rad\n";
  for (int i = 0; i < 100; ++i) table += std::to_string(0.1 * i) + ',' + std::to_string(0.03 * (i % 50)) + ",0,0\n";
  const auto read = odometry(table, "");
  ASSERT_TRUE(read) << text(read.error());
  EXPECT_EQ(read->at(49).origin, 0u);
  EXPECT_EQ(read->at(50).origin, 1u);
  EXPECT_GT(read->at(50).sigma_gap_m, 0.02);
}

TEST(ForeignTruth, NeedsNoHeading) {
  TableNotes notes;
  const auto truth = foreign_truth({"t,x,y\n1,2,3\n", "t.csv", "t_s=t,x_m=x,y_m=y", "-"}, notes);
  ASSERT_TRUE(truth) << text(truth.error());
  EXPECT_EQ(truth->front().T_world_body.y_m, 3.0);
  EXPECT_TRUE(std::isnan(truth->front().T_world_body.heading_rad));
}

TEST(ForeignTruth, ReadsPosesOfAnotherProgram) {
  TableNotes notes;
  const auto truth = foreign_truth({"t,x,y,th\n1,2,3,0.5\n", "t.csv", "t_s=t,x_m=x,y_m=y,heading_rad=th", "-"}, notes);
  ASSERT_TRUE(truth) << text(truth.error());
  EXPECT_EQ(truth->front().T_world_body, (Pose2{2, 3, 0.5}));
}

}  // namespace
}  // namespace azimuth::test
