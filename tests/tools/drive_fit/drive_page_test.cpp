// Tests the page of a calibration, and the residuals that it shows.

#include "tools/drive_fit/drive_page.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/drive_of.hpp"
#include "tools/drive_fit/drive_picture.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kRogue = "</td></pre><script>\"&\n";
const std::string kRogueAsText = "&lt;/td&gt;&lt;/pre&gt;&lt;script&gt;&quot;&amp;";

TEST(DrivePage, ShowsForeignTextAsText) {
  const std::string page = drive_page({.run = kRogue,
                                       .made_by = kRogue,
                                       .rig_file = kRogue,
                                       .found = {{kRogue, kRogue, kRogue, kRogue, kRogue, true, kRogue}},
                                       .untold = {{kRogue, kRogue}},
                                       .figures = {{kRogue, kRogue, "data:,\">"}},
                                       .rig_text = kRogue});
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  std::size_t count = 0;
  for (std::size_t at = page.find(kRogueAsText); at != std::string::npos; at = page.find(kRogueAsText, at + 1)) ++count;
  EXPECT_EQ(count, 16U) << "title, heading, rig and maker; six cells of a value; two of an untold one; three of a "
                           "picture; and the file";
  EXPECT_THAT(page, HasSubstr("src=\"data:,&quot;&gt;\""));
}

TEST(DrivePage, WithoutFindingsHasNoEmptyTables) {
  const std::string page = drive_page(
      {.run = "run", .made_by = "", .rig_file = "", .found = {}, .untold = {}, .figures = {}, .rig_text = ""});
  EXPECT_THAT(page, Not(HasSubstr("<table")));
  EXPECT_THAT(page, HasSubstr("there was no rig.toml"));
}

class ResidualsOfALap : public testing::Test {
 protected:
  ResidualsOfALap() {
    const auto run = simulated_run(lab(21, 1));
    rig_ = test::rig_of_run(run);
    drive_ = test::drive_of(run, rig_);
    solution_ = followed_and_solved(drive_, {.rig = rig_}, {}, {});
  }
  Rig rig_;
  Drive drive_;
  DriveSolution solution_;
};

TEST_F(ResidualsOfALap, AreThoseOfTheFit) {
  const auto residuals = residuals_with(drive_, solution_.graph, {.rig = rig_}, {});
  EXPECT_GT(residuals.size(), 9 * solution_.graph.bearings() / 10);
  EXPECT_NEAR(share_within(residuals, 3.0), solution_.fitting, 0.01);
  EXPECT_NEAR(share_within(residuals, 2.0), 0.954, 0.03) << "the simulated noise is that of the rig";
}

TEST_F(ResidualsOfALap, ShowAWrongHeading) {
  Rig askew = rig_;
  askew.camera.yaw_offset_rad += 0.15;
  const double right = share_within(residuals_with(drive_, solution_.graph, {.rig = rig_}, {}), 2.0);
  EXPECT_LT(share_within(residuals_with(drive_, solution_.graph, {.rig = askew}, {}), 2.0), right - 0.1);
}

TEST_F(ResidualsOfALap, ArePositiveWhereTheMeasuredAzimuthIsTooLarge) {
  DriveGraph graph = solution_.graph;
  Bearing& bearing = graph.places[graph.places.size() / 2].seen.front().bearing;
  bearing.azimuth_rad += 10.0 * bearing.sigma_rad;
  const auto largest = std::ranges::max(residuals_with(drive_, graph, {.rig = rig_}, {}), {},
                                        [](const PlottedResidual& each) { return std::abs(each.sigmas); });
  EXPECT_NEAR(largest.sigmas, 10.0, 3.0);
}

}  // namespace
}  // namespace azimuth
