// Runs `azimuth calibrate` on a drive, with all steps and with single ones, and `azimuth check`, as commands.

#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "settings/rig.hpp"
#include "tests/support/data.hpp"
#include "tests/tools/azimuth/command_line.hpp"

namespace azimuth::test {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

class CalibrateDrive : public testing::Test {
 protected:
  ScratchFolder scratch_;
  std::string rig_ = scratch_ / "found.toml", picture_ = scratch_ / "found.svg", page_ = scratch_ / "found.html";
};

TEST_F(CalibrateDrive, OdometryWritesARigAndAPicture) {
  const Outcome outcome = azimuth({"calibrate", "odometry", one_lap(), "--out", rig_, "--picture", picture_});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("turn        scale_turn = "));
  EXPECT_THAT(outcome.out, HasSubstr("lag         lag_s = "));
  EXPECT_THAT(outcome.out, HasSubstr("distance    cannot tell: bearings know no lengths"));
  EXPECT_THAT(file_bytes(picture_), HasSubstr("stroke:rgb(0%,62%,45.1%)")) << "odometry, calibrated";
  const auto rig = read_rig_file(rig_);
  ASSERT_TRUE(rig) << text(rig.error());
  EXPECT_NEAR(rig->odometry.scale_turn, 1.0, 0.05);
  EXPECT_NEAR(rig->odometry.lag_s, 0.0, 0.1);
  EXPECT_EQ(rig->odometry.scale_distance, 1.0);
  EXPECT_EQ(azimuth({"replay", one_lap(), "--rig", rig_, "--quiet"}).code, 0);
  EXPECT_THAT(azimuth({"calibrate", "odometry", one_lap(), "--out", rig_}).err, HasSubstr("exists already"));
}

TEST_F(CalibrateDrive, TruthTellsTheScaleOfDistances) {
  const Outcome outcome =
      azimuth({"calibrate", "odometry", one_lap(), "--truth", one_lap() + "/truth.csv", "--out", rig_});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("distance    scale_distance = "));
  EXPECT_NEAR(read_rig_file(rig_)->odometry.scale_distance, 1.0, 0.02);
}

TEST_F(CalibrateDrive, HeadingWritesARigAndAPicture) {
  const Outcome outcome = azimuth({"calibrate", "heading", one_lap(), "--out", rig_, "--picture", picture_});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("direction   camera.azimuths_clockwise = false"));
  const auto rig = read_rig_file(rig_);
  ASSERT_TRUE(rig) << text(rig.error());
  EXPECT_NEAR(rig->camera.yaw_offset_rad, 0.0, 0.5 * 3.14159 / 180.0);
  EXPECT_THAT(file_bytes(picture_), HasSubstr("<svg"));
}

/// A copy of one lap without its rig. The camera is turned by `yaw_rad`; `clockwise` mirrors the azimuths.
std::string lap_without_rig(const std::string& folder, double yaw_rad, bool clockwise = false) {
  std::filesystem::copy(one_lap(), folder, std::filesystem::copy_options::recursive);
  std::filesystem::remove(folder + "/rig.toml");
  std::istringstream rows(file_bytes(one_lap() + "/bearings.csv"));
  std::string line, table;
  std::getline(rows, line);
  std::vector<std::string> names;
  std::istringstream header(line);
  for (std::string name; std::getline(header, name, ',');) names.push_back(name);
  table = line + '\n';
  while (std::getline(rows, line)) {
    std::istringstream fields(line);
    std::string field, row;
    for (std::size_t i = 0; std::getline(fields, field, ','); ++i) {
      if (names[i] == "azimuth_rad") {
        const double turned_rad = std::stod(field) - yaw_rad;
        field = std::to_string(std::remainder(clockwise ? -turned_rad : turned_rad, 2.0 * 3.14159265358979));
      }
      row += (i > 0 ? "," : "") + field;
    }
    table += row + '\n';
  }
  write_file(folder + "/bearings.csv", table);
  return folder;
}

TEST_F(CalibrateDrive, ARunTellsARigFromNone) {
  const std::string run = lap_without_rig(scratch_ / "lap", 0.2);
  const Outcome outcome = azimuth({"calibrate", run, "--out", rig_, "--picture", picture_});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto rig = read_rig_file(rig_);
  ASSERT_TRUE(rig) << text(rig.error());
  EXPECT_NEAR(rig->camera.yaw_offset_rad, 0.2, 0.01);
  EXPECT_TRUE(rig->camera.identities);
  EXPECT_NEAR(rig->odometry.scale_turn, 1.0, 0.05);
  EXPECT_THAT(file_bytes(rig_), HasSubstr("# Found: camera.yaw_offset_rad = 0."));
  EXPECT_THAT(outcome.out, HasSubstr("distance    cannot tell: bearings know no lengths"));
  EXPECT_THAT(file_bytes(picture_), HasSubstr("<svg"));
  EXPECT_EQ(azimuth({"replay", run, "--rig", rig_, "--quiet"}).code, 0);
  EXPECT_THAT(azimuth({"calibrate", run, "--out", rig_}).err, HasSubstr("exists already"));
}

TEST_F(CalibrateDrive, ARunTellsThatAzimuthsGrowClockwise) {
  const std::string run = lap_without_rig(scratch_ / "lap", -0.1, true);
  const Outcome outcome = azimuth({"calibrate", run, "--out", rig_});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto rig = read_rig_file(rig_);
  ASSERT_TRUE(rig) << text(rig.error());
  EXPECT_TRUE(rig->camera.azimuths_clockwise);
  EXPECT_NEAR(rig->camera.yaw_offset_rad, -0.1, 0.01);
}

TEST_F(CalibrateDrive, ARigThatIsRightStaysAsItIs) {
  const Outcome outcome = azimuth({"calibrate", one_lap(), "--out", rig_});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto rig = read_rig_file(rig_), said = read_rig_file(one_lap() + "/rig.toml");
  ASSERT_TRUE(rig) << text(rig.error());
  EXPECT_EQ(rig->odometry.scale_turn, said->odometry.scale_turn);
  EXPECT_EQ(rig->odometry.scale_distance, said->odometry.scale_distance);
  EXPECT_NEAR(rig->camera.yaw_offset_rad, said->camera.yaw_offset_rad, 0.01);
  EXPECT_THAT(outcome.out, HasSubstr("as it was: the drive does not contradict that"));
}

TEST_F(CalibrateDrive, WhatIsNotAskedForStaysAsItWas) {
  const std::string run = lap_without_rig(scratch_ / "lap", 0.2), said_file = scratch_ / "said.toml";
  Rig said;
  said.camera.identities = true;
  said.odometry.scale_turn = 1.02;
  write_file(said_file, rig_text(said));
  const Outcome outcome = azimuth({"calibrate", run, "--rig", said_file, "--only", "heading,lag", "--out", rig_});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto rig = read_rig_file(rig_);
  ASSERT_TRUE(rig) << text(rig.error());
  EXPECT_NEAR(rig->camera.yaw_offset_rad, 0.2, 0.01);
  EXPECT_LT(rig->camera.sigma_yaw_rad, 0.005);
  EXPECT_NEAR(rig->odometry.lag_s, 0.0, 0.05);
  EXPECT_EQ(rig->odometry.scale_turn, 1.02);
  EXPECT_EQ(rig->odometry.sigma_scale_turn, said.odometry.sigma_scale_turn);
  EXPECT_EQ(rig->odometry.lambda_rotation_rad, said.odometry.lambda_rotation_rad);
  EXPECT_EQ(rig->camera.sigma_bearing_rad, said.camera.sigma_bearing_rad);
  EXPECT_THAT(outcome.out, HasSubstr("direction   camera.azimuths_clockwise = false"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("scale_turn")));
  EXPECT_THAT(azimuth({"calibrate", run, "--only", "optics"}).err, HasSubstr("heading"));
  EXPECT_EQ(azimuth({"calibrate", "--only", "lag", "heading", run}).code, 2) << "it would have been of no effect";
}

TEST_F(CalibrateDrive, BeforeTheDirectionIsRightNothingElseIsTold) {
  const std::string run = lap_without_rig(scratch_ / "lap", -0.1, true);
  const Outcome outcome = azimuth({"calibrate", run, "--only", "turn", "--out", rig_});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--only heading first"));
}

/// What follows `begin` in the lines of `text` that hold it.
std::vector<std::string> ends_of_lines(const std::string& text, const std::string& begin) {
  std::vector<std::string> ends;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (const std::size_t at = line.find(begin); at != std::string::npos)
      ends.push_back(line.substr(at + begin.size()));
  return ends;
}

TEST_F(CalibrateDrive, APageSaysWhatIsPrintedAndShowsTheRigThatIsWritten) {
  write_file(page_, "of another drive");
  EXPECT_THAT(azimuth({"calibrate", one_lap(), "--html", page_}).err, HasSubstr("found.html: exists already; --force"));
  EXPECT_EQ(file_bytes(page_), "of another drive");
  const Outcome outcome = azimuth({"calibrate", one_lap(), "--out", rig_, "--html", page_, "--force"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string page = file_bytes(page_);
  const std::vector<std::string> untold = ends_of_lines(outcome.out, "cannot tell: "),
                                 kept = ends_of_lines(outcome.out, ", as it was");
  ASSERT_EQ(untold.size(), 1U) << outcome.out;
  EXPECT_THAT(page, HasSubstr(">" + untold.front() + "</td>"));
  ASSERT_FALSE(kept.empty()) << outcome.out;
  std::size_t kept_in_page = 0;
  for (const std::string& row : ends_of_lines(page, "<td><code>")) kept_in_page += row.find("fits the rig: kept") < 999;
  EXPECT_GE(kept_in_page, kept.size());
  for (const std::string key : {"camera.yaw_offset_rad", "odometry.scale_turn", "camera.sigma_bearing_rad"})
    EXPECT_THAT(page, HasSubstr("<td><code>" + key + "</code></td>"));
  EXPECT_THAT(page, HasSubstr(">" + std::regex_replace(file_bytes(rig_), std::regex("\""), "&quot;") + "</pre>"))
      << "as --out writes it";
  EXPECT_EQ(ends_of_lines(page, "src=\"data:image/svg+xml;base64,").size(), 2U);
}

TEST_F(CalibrateDrive, APageNamesTheMotionsThatAShortDriveLacks) {
  const std::string run = scratch_ / "short";
  std::filesystem::copy(one_lap(), run, std::filesystem::copy_options::recursive);
  for (const std::string table : {"/odometry.csv", "/bearings.csv"}) {
    std::istringstream all(file_bytes(run + table));
    std::string line, kept;
    while (std::getline(all, line))
      if (kept.empty() || std::stod(line) <= 20.0) kept += line + '\n';
    write_file(run + table, kept);
  }
  const Outcome outcome = azimuth({"calibrate", run, "--html", page_});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::vector<std::string> untold = ends_of_lines(outcome.out, "cannot tell: ");
  ASSERT_GE(untold.size(), 3U) << outcome.out;
  const std::string page = file_bytes(page_);
  for (const std::string& sentence : untold) EXPECT_THAT(page, HasSubstr(">" + sentence + "</td>"));
  EXPECT_THAT(page, HasSubstr(">scale_turn; drive longer, among landmarks, with turns both ways</td>"));
  EXPECT_THAT(page, Not(HasSubstr("<code>odometry.scale_turn</code>"))) << "what is not told is not found";
}

TEST_F(CalibrateDrive, APageOfARunWithoutARigComparesWithDefaults) {
  const Outcome outcome = azimuth({"calibrate", lap_without_rig(scratch_ / "lap", 0.2), "--html", page_});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string page = file_bytes(page_);
  const auto yaw = ends_of_lines(outcome.out, "camera.yaw_offset_rad = "),
             row = ends_of_lines(page, "camera.yaw_offset_rad</code>");
  ASSERT_EQ(yaw.size(), 1U);
  ASSERT_FALSE(row.empty());
  EXPECT_THAT(row.front(), HasSubstr(">0.0000 (0.00\u00b0)</td><td class=\"number\">" + yaw.front().substr(0, 6)));
  EXPECT_THAT(row.front(), HasSubstr("differs from the default: replaced"));
  EXPECT_THAT(page, HasSubstr("there was no rig.toml"));
  EXPECT_THAT(page, Not(HasSubstr("the rig:")));
}

TEST_F(CalibrateDrive, APageThatCannotBeWrittenIsRefusedBeforeAnyWork) {
  const std::string nowhere = scratch_ / "nowhere/found.html";
  const Outcome outcome = azimuth({"calibrate", one_lap(), "--html", nowhere});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr(nowhere + ": cannot be written: No such file or directory"));
  EXPECT_THAT(outcome.out, testing::IsEmpty());
  EXPECT_EQ(azimuth({"calibrate", "--html", page_, "heading", one_lap()}).code, 2) << "it would have been of no effect";
}

TEST_F(CalibrateDrive, ImagesTellTheOpticsFirst) {
  const std::string run = scratch_ / "mirror";
  std::filesystem::copy(shipped_run().parent_path() / "mirror", run, std::filesystem::copy_options::recursive);
  std::filesystem::remove(run + "/rig.toml");
  const Outcome outcome = azimuth({"calibrate", run, "--out", rig_, "--html", page_});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("mirror      centre ("));
  const std::string page = file_bytes(page_);
  EXPECT_THAT(page, HasSubstr("src=\"data:image/png;base64,"));
  EXPECT_THAT(page, HasSubstr("<code>camera.centre_px</code>"));
  EXPECT_THAT(page, HasSubstr("cannot tell without more images to a metre</td>"));
  const auto rig = read_rig_file(rig_);
  ASSERT_TRUE(rig) << text(rig.error());
  EXPECT_TRUE(rig->camera.image.centre_px);
}

// Half a minute below lamps: nothing says that the camera looks up, nor how it is turned.
TEST_F(CalibrateDrive, LampsTellAFisheyeOfWhichNothingIsKnown) {
  const std::string run = scratch_ / "lamps";
  std::filesystem::copy(shipped_run().parent_path() / "lamps", run, std::filesystem::copy_options::recursive);
  const Rig truth = *read_rig_file(run + "/rig.toml");
  std::filesystem::remove(run + "/rig.toml");
  const Outcome outcome = azimuth({"calibrate", run, "--out", rig_, "--html", page_});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("heading     camera.azimuth_offset_rad = "));
  EXPECT_THAT(file_bytes(page_), HasSubstr("<code>camera.azimuth_offset_rad</code>"));
  const auto rig = read_rig_file(rig_);
  ASSERT_TRUE(rig) << text(rig.error());
  EXPECT_EQ(rig->front_end, FrontEnd::lamps);
  const ImageRig &found = rig->camera.image, &right = truth.camera.image;
  EXPECT_EQ(found.azimuth_direction, right.azimuth_direction);
  EXPECT_NEAR(wrap(found.azimuth_offset_rad - right.azimuth_offset_rad), 0.0, 0.01);
  EXPECT_NEAR(found.centre_px->at(0), right.centre_px->at(0), 1.0);
  EXPECT_EQ(azimuth({"calibrate", run, "--rig", rig_}).code, 0) << "a rig to begin with";
  EXPECT_EQ(azimuth({"calibrate", run, "--rig", rig_, "--only", "lag"}).code, 2);
}

TEST_F(CalibrateDrive, ARunOfNoUseSaysWhy) {
  EXPECT_THAT(azimuth({"calibrate"}).err, HasSubstr("RUN or a subcommand"));
  EXPECT_EQ(azimuth({"calibrate"}).code, 2);
  const Outcome outcome = azimuth({"calibrate", (shipped_run().parent_path() / "alike").string()});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("which landmark it is of"));
}

TEST_F(CalibrateDrive, ARigThatCheckPutsRightIsRight) {
  const std::string folder = one_lap(), said = scratch_ / "turned.toml";
  Rig rig = *read_rig_file(folder + "/rig.toml");
  rig.camera.yaw_offset_rad = 1.5;
  write_file(said, rig_text(rig));
  const Outcome wrong = azimuth({"check", folder, "--rig", said, "--out", rig_});
  EXPECT_EQ(wrong.code, 1) << wrong.err;
  EXPECT_THAT(wrong.out, HasSubstr("heading     WRONG: the camera's heading is off by -8"));
  const Outcome right = azimuth({"check", folder, "--rig", rig_});
  EXPECT_EQ(right.code, 0) << right.out;
  EXPECT_THAT(right.out, Not(HasSubstr("WRONG")));
}

TEST_F(CalibrateDrive, ReadingsASecondApartAreJudgedAndNotRefused) {
  // GIVEN one reading a second, and a rig whose lag makes the next reading arrive later than the live pipeline waits
  const std::string folder = scratch_ / "slow", late = scratch_ / "late.toml";
  std::filesystem::copy(one_lap(), folder, std::filesystem::copy_options::recursive);
  std::istringstream all(file_bytes(folder + "/odometry.csv"));
  std::string line, table;
  while (std::getline(all, line))
    if (table.empty() || line.find(".000000,") < line.find(',')) table += line + '\n';
  write_file(folder + "/odometry.csv", table);
  Rig rig = *read_rig_file(folder + "/rig.toml");
  rig.odometry.lag_s = 0.3;
  write_file(late, rig_text(rig));
  // THEN the drive is judged, and the verdict blames the time: a lag, or a clock, which so few readings cannot separate
  const Outcome outcome = azimuth({"check", folder, "--rig", late});
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_THAT(outcome.out, AnyOf(HasSubstr("lag         WRONG"), HasSubstr("clock       WRONG")));
  EXPECT_THAT(outcome.err, Not(HasSubstr("milliseconds")));
}

TEST_F(CalibrateDrive, FisheyeWantsImagesAndAPictureOfPixels) {
  const Outcome outcome = azimuth({"calibrate", "fisheye", one_lap(), "--out", rig_});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("has no images: a lens is calibrated by where lamps are in them, in pixels"));
  EXPECT_THAT(azimuth({"calibrate", "fisheye", one_lap(), "--picture", picture_}).err,
              HasSubstr("the name of a picture of pixels must end in .png"));
}

TEST_F(CalibrateDrive, CheckOfBearingsWithoutNamesSaysThatItCannotTell) {
  const Outcome outcome = azimuth({"check", one_lap(), "--no-names"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("cannot tell without (camera.identities)"));
}

/// Checks a run of images, whose bearings have no identities.
class CheckOffice : public testing::Test {
 protected:
  void SetUp() override {
    AZIMUTH_REQUIRE_DATA("office-a");
    rig_.front_end = FrontEnd::colour;
  }
  Outcome checked() const {
    write_file(said_, rig_text(rig_));
    return azimuth({"check", folder_, "--rig", said_});
  }
  ScratchFolder scratch_;
  std::string folder_ = data_folder() / "office-a", said_ = scratch_ / "said.toml";
  Rig rig_ = read_rig_file(folder_ + "/rig.toml").value_or(Rig{});
};

TEST_F(CheckOffice, OfARigThatIsRightNothingIsWrong) {
  const Outcome outcome = checked();
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("direction   fits"));
  EXPECT_THAT(outcome.out, HasSubstr("tilt        cannot tell: known to +- ")) << "its cylinders stand at the horizon";
}

TEST_F(CheckOffice, AFlippedDirectionIsNamed) {
  rig_.camera.image.azimuth_direction = 1;
  const Outcome outcome = checked();
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("direction   WRONG: azimuths grow the other way than the rig says: "
                                     "camera.azimuth_direction = -1"));
}

TEST_F(CheckOffice, ACentreThatIsOffIsNamed) {
  rig_.camera.image.centre_px = {524.0, 368.0};
  const Outcome outcome = checked();
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("centre      WRONG: the image's centre is 20 px off: camera.centre_px = [511."));
}

TEST_F(CheckOffice, CalibrateHeadingFindsAFlippedDirection) {
  rig_.camera.image.azimuth_direction = 1;
  write_file(said_, rig_text(rig_));
  const Outcome outcome = azimuth({"calibrate", "heading", folder_, "--rig", said_});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("direction   camera.azimuth_direction = -1, which the rig has the other way"));
}

}  // namespace
}  // namespace azimuth::test
