#include "drivers/storage/tables.hpp"

#include <gmock/gmock.h>
#include <numbers>
#include <rapidcheck/gtest.h>

#include "tests/drivers/storage/samples.hpp"

namespace azimuth {
namespace {

using ::testing::SizeIs;

/// The errors of a table as text; `read` is one of the reading functions.
template <class Read, class... More>
std::string errors_of(Read read, std::string_view text, More&&... more) {
  FileErrors errors;
  read({text, "t.csv"}, errors, more...);
  return azimuth::text(errors);
}

std::string odometry_errors(const std::string& rows) {
  std::uint64_t skipped = 0;
  return errors_of(read_odometry_table, "t_s,x_m,y_m,heading_rad\n" + rows, skipped);
}

std::string bearings_errors(const std::string& rows) {
  return errors_of(read_bearings_table, "t_s,azimuth_rad,elevation_rad,landmark_id\n" + rows);
}

std::vector<BearingSet> bearings(const std::string& text) {
  FileErrors errors;
  auto sets = read_bearings_table({text, "t.csv"}, errors);
  EXPECT_EQ(azimuth::text(errors), "");
  return sets;
}

TEST(OdometryTable, NamesEachWrongValue) {
  EXPECT_EQ(odometry_errors("zero,1,2,3\n"), "t.csv:2: t_s \"zero\" is not a time in seconds, or out of range\n");
  EXPECT_EQ(odometry_errors("0,1 m,nan,inf\n"),
            "t.csv:2: x_m \"1 m\" is not a number\n"
            "t.csv:2: y_m \"nan\" is not finite\n"
            "t.csv:2: heading_rad \"inf\" is not finite\n");
  EXPECT_EQ(odometry_errors("0,1e8,0,0\n"), "t.csv:2: x_m \"1e8\" is out of range\n");
  EXPECT_EQ(odometry_errors("0,,0,0\n"), "t.csv:2: x_m is empty\n");
}

TEST(OdometryTable, EarlierStampIsAnErrorOfItsRowOnly) {
  EXPECT_EQ(odometry_errors("1,0,0,0\n2,0,0,0\n1.5,0,0,0\n3,0,0,0\n"),
            "t.csv:4: t_s is earlier than in the row above\n");
  EXPECT_EQ(odometry_errors("1,0,0,0\n1e6,0,0,0\n2,0,0,0\n3,0,0,0\n"),
            "t.csv:4: t_s is earlier than in the row above\n");
}

TEST(OdometryTable, RepeatedStampIsSkippedAndCounted) {
  FileErrors errors;
  std::uint64_t skipped = 0;
  const auto readings = read_odometry_table(
      {"t_s,x_m,y_m,heading_rad\n1,10,0,0\n1.0000001,11,0,0\n2,12,0,0\n", "t.csv"}, errors, skipped);
  EXPECT_TRUE(errors.empty());
  EXPECT_EQ(skipped, 1U);
  ASSERT_THAT(readings, SizeIs(2));
  EXPECT_EQ(readings[0].T_odom_body.x_m, 10.0);
  EXPECT_EQ(readings[1].T_odom_body.x_m, 12.0);
  EXPECT_EQ(readings[1].sequence, 1U) << "a repeated reading is no lost one";
}

TEST(OdometryTable, WithoutRowsIsAnError) {
  EXPECT_EQ(odometry_errors(""), "t.csv: has no rows\n");
  std::uint64_t skipped = 0;
  EXPECT_EQ(errors_of(read_odometry_table, "", skipped), "t.csv: is empty\n");
}

TEST(OdometryTable, CountedTurnsAreWrapped) {
  FileErrors errors;
  std::uint64_t skipped = 0;
  const auto readings = read_odometry_table({"t_s,x_m,y_m,heading_rad\n0,0,0,63\n", "t.csv"}, errors, skipped);
  ASSERT_THAT(readings, SizeIs(1));
  EXPECT_NEAR(readings[0].T_odom_body.heading_rad, 63.0 - 20.0 * std::numbers::pi, 1e-12);
}

TEST(BearingsTable, EqualStampsMakeOneSet) {
  const auto sets = bearings("t_s,azimuth_rad\n0.5,1\n0.5,-1\n0.500001,2\n");
  ASSERT_THAT(sets, SizeIs(2));
  EXPECT_THAT(sets[0].bearings, SizeIs(2));
  EXPECT_EQ(sets[1].stamp, stamp_from_us(500'001));
  EXPECT_EQ(sets[1].sequence, 1U);
  EXPECT_EQ(sets[0].bearings[0].identity, kUnknownIdentity);
  EXPECT_TRUE(std::isnan(sets[0].bearings[0].elevation_rad));
}

TEST(BearingsTable, EmptyElevationIsNotMeasuredAndMinusOneUnknown) {
  const auto sets = bearings("t_s,azimuth_rad,elevation_rad,landmark_id\n0,1,,-1\n0,1,0.25,7\n");
  ASSERT_THAT(sets, SizeIs(1));
  EXPECT_TRUE(std::isnan(sets[0].bearings[0].elevation_rad));
  EXPECT_EQ(sets[0].bearings[0].identity, kUnknownIdentity);
  EXPECT_EQ(sets[0].bearings[1].elevation_rad, 0.25);
  EXPECT_EQ(sets[0].bearings[1].identity, 7);
}

TEST(BearingsTable, EmptyNamesStandBesideOthers) {
  const auto sets = bearings("t_s,azimuth_rad,landmark_id,kind\n0,1,,\n0,1,7,3\n");
  ASSERT_THAT(sets, SizeIs(1));
  EXPECT_EQ(sets[0].bearings[0].identity, kUnknownIdentity);
  EXPECT_EQ(sets[0].bearings[0].kind, kAnyKind);
  EXPECT_EQ(sets[0].bearings[1].identity, 7);
}

TEST(BearingsTable, NoneIsAnImageInWhichNothingWasFound) {
  const auto sets = bearings("t_s,azimuth_rad,landmark_id\n0,none,\n1,0.5,3\n");
  ASSERT_THAT(sets, SizeIs(2));
  EXPECT_TRUE(sets[0].bearings.empty());
  EXPECT_EQ(bearings_errors("0,none,,3\n"), "t.csv:2: azimuth_rad none with further values\n");
  EXPECT_EQ(bearings_errors("0,1,,3\n0,none,,\n"), "t.csv:3: azimuth_rad none beside other rows of equal t_s\n");
  EXPECT_EQ(bearings_errors("0,none,,\n0,1,,3\n"), "t.csv:3: bearings beside azimuth_rad none of equal t_s\n");
  EXPECT_EQ(bearings_errors("0,170,,1\n0,1,,3\n"), "t.csv:2: azimuth_rad \"170\" is out of range: in degrees?\n");
}

TEST(BearingsTable, AnImageHasNoMoreBearingsThanAMessage) {
  const auto rows = [](int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += "0,1,,-1\n";
    return text;
  };
  EXPECT_EQ(bearings_errors(rows(16384) + "1,1,,-1\n"), "");
  EXPECT_EQ(bearings_errors(rows(16385)),
            "t.csv:16386: more than 16384 bearings of equal t_s: no image shows so many\n");
}

TEST(BearingsTable, AWordSaysWhatIsWrongWithTheImage) {
  const auto sets = bearings("t_s,azimuth_rad,kind\n0,dark,\n1,unreadable,\n2,frozen,\n3,0.5,1\n4,none,\n");
  ASSERT_THAT(sets, SizeIs(5));
  EXPECT_EQ(sets[0].trouble, ImageTrouble::dark);
  EXPECT_EQ(sets[1].trouble, ImageTrouble::unreadable);
  EXPECT_EQ(sets[2].trouble, ImageTrouble::frozen);
  EXPECT_EQ(sets[3].trouble, ImageTrouble::none);
  EXPECT_EQ(sets[4].trouble, ImageTrouble::none);
  EXPECT_EQ(bearings_errors("0,dark,,3\n"), "t.csv:2: azimuth_rad dark with further values\n");
  EXPECT_EQ(bearings_errors("0,1,,3\n0,dark,,\n"), "t.csv:3: azimuth_rad dark beside other rows of equal t_s\n");
}

TEST(BearingsTable, KindAndNoiseOfABearing) {
  const auto sets = bearings("t_s,azimuth_rad,kind,sigma_rad\n0,1,-1,\n0,1,7,0.02\n");
  ASSERT_THAT(sets, SizeIs(1));
  EXPECT_EQ(sets[0].bearings[0].kind, kAnyKind);
  EXPECT_TRUE(std::isnan(sets[0].bearings[0].sigma_rad));
  EXPECT_EQ(sets[0].bearings[1].kind, 7);
  EXPECT_EQ(sets[0].bearings[1].sigma_rad, 0.02);
  EXPECT_EQ(errors_of(read_bearings_table, "t_s,azimuth_rad,kind,sigma_rad\n0,1,-2,0\n1,1,3000000000,-1\n2,1,,nan\n"),
            "t.csv:2: kind \"-2\" is out of range\n"
            "t.csv:2: sigma_rad \"0\" is out of range\n"
            "t.csv:3: kind \"3000000000\" is out of range\n"
            "t.csv:3: sigma_rad \"-1\" is out of range\n"
            "t.csv:4: sigma_rad \"nan\" is not finite\n");
}

TEST(BearingsTable, NamesEachWrongValue) {
  EXPECT_EQ(bearings_errors("0,left,high,\n"),
            "t.csv:2: azimuth_rad \"left\" is not a number\n"
            "t.csv:2: elevation_rad \"high\" is not a number\n");
  EXPECT_EQ(bearings_errors("0,NaN,nan,1.5\n"),
            "t.csv:2: azimuth_rad \"NaN\" is not finite\n"
            "t.csv:2: elevation_rad \"nan\" is not finite\n"
            "t.csv:2: landmark_id \"1.5\" is not a whole number\n");
  EXPECT_EQ(bearings_errors("0,180,90,-2\n"),
            "t.csv:2: azimuth_rad \"180\" is out of range: in degrees?\n"
            "t.csv:2: elevation_rad \"90\" is out of range: in degrees?\n"
            "t.csv:2: landmark_id \"-2\" is out of range\n");
  EXPECT_EQ(bearings_errors("1,0,0,0\n0,0,0,0\n"), "t.csv:3: t_s is earlier than in the row above\n");
  EXPECT_EQ(bearings_errors(""), "t.csv: has no rows\n");
}

TEST(FramesTable, PathsStayBelowTheFolder) {
  for (const char* file : {"", "/etc/passwd", "../secret.jpg", "frames/../../secret.jpg", ".."}) {
    EXPECT_EQ(errors_of(read_frames_table, "t_s,file\n0," + std::string(file) + "\n"),
              "t.csv:2: file is not a path below the run folder\n");
  }
  EXPECT_EQ(errors_of(read_frames_table, "t_s,file\n0,frames/0..1.jpg\n"), "");
}

TEST(FramesTable, RepeatedStampIsAnError) {
  EXPECT_EQ(errors_of(read_frames_table, "t_s,file\n0,a.jpg\n0,b.jpg\n"), "t.csv:3: t_s is that of the row above\n");
}

TEST(LandmarksTable, NamesEachWrongValue) {
  EXPECT_EQ(errors_of(read_landmarks_table, "landmark_id,x_m,y_m,z_m,kind\n-1,x,nan,high,\n1,0,0,,\n1,0,0,,\n"),
            "t.csv:2: landmark_id \"-1\" is out of range\n"
            "t.csv:2: x_m \"x\" is not a number\n"
            "t.csv:2: y_m \"nan\" is not finite\n"
            "t.csv:2: z_m \"high\" is not a number\n"
            "t.csv:4: landmark_id 1 is repeated\n");
}

/// A round trip of random runs through the tables.
RC_GTEST_PROP(Tables, ComeBackBitForBit, (unsigned seed)) {
  const Run run = test::example_run(20, seed);
  FileErrors errors;
  std::uint64_t skipped = 0;
  const auto odometry = odometry_table(run.odometry), sets = bearings_table(run.bearings),
             truth = truth_table(run.truth), landmarks = landmarks_table(run.landmarks),
             frames = frames_table(run.frames);
  RC_ASSERT(test::same_bits(read_odometry_table({odometry, "o"}, errors, skipped), run.odometry));
  RC_ASSERT(test::same_bits(read_bearings_table({sets, "b"}, errors), run.bearings));
  RC_ASSERT(test::same_bits(read_truth_table({truth, "t"}, errors, skipped), run.truth));
  RC_ASSERT(test::same_bits(read_landmarks_table({landmarks, "l"}, errors), run.landmarks));
  RC_ASSERT(read_frames_table({frames, "f"}, errors) == run.frames);
  RC_ASSERT(errors.empty());
  RC_ASSERT(skipped == 0U);
}

}  // namespace
}  // namespace azimuth
