#include "tools/plot/map_picture.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <system_error>

#include "tests/support/temporary_folder.hpp"

namespace azimuth {
namespace {

std::string bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

MapPicture made_picture() {
  MapPicture picture;
  picture.title = "made";
  picture.subtitle = "position RMSE 0.1 m";
  PlotLine path;
  for (int i = 0; i <= 20; ++i) {
    path.emplace_back(i, std::sin(0.3 * i));
    picture.odometry.emplace_back(i, std::sin(0.3 * i) + 0.05 * i);
  }
  picture.estimate = {{path, false}};
  picture.truth = {path};
  picture.poses = {{{10.0, 0.1}, 0.01 * Eigen::Matrix2d::Identity()}};
  picture.landmarks = {{{{5.0, 3.0}, 0.02 * Eigen::Matrix2d::Identity()}, "7", -1, true}};
  picture.true_landmarks = {{5.1, 3.0}};
  picture.T_map_body = Pose2{20.0, 0.0, 0.4};
  return picture;
}

class MapPictureFile : public testing::Test {
 protected:
  std::filesystem::path scratch(const std::string& name) const { return folder_ / name; }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(MapPictureFile, IsAPng) {
  const auto file = scratch("map.png");
  ASSERT_EQ(write_map_picture(made_picture(), file), std::nullopt);
  const std::string png = bytes(file);
  ASSERT_GT(png.size(), 10000u);
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  const auto width = (static_cast<unsigned char>(png[18]) << 8) + static_cast<unsigned char>(png[19]);
  EXPECT_EQ(width, 1600);
}

TEST_F(MapPictureFile, IsTheSameEachTime) {
  for (const char* ending : {".png", ".svg", ".pdf"}) {
    const auto first = scratch(std::string("first") + ending), second = scratch(std::string("second") + ending);
    ASSERT_EQ(write_map_picture(made_picture(), first), std::nullopt);
    ASSERT_EQ(write_map_picture(made_picture(), second), std::nullopt);
    EXPECT_TRUE(bytes(first) == bytes(second)) << ending;
  }
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// The text of the SVG file of this picture.
std::string svg_of(const MapPicture& picture, const std::filesystem::path& file) {
  EXPECT_EQ(write_map_picture(picture, file), std::nullopt);
  return bytes(file);
}

/// The stroke of the odometry line, which appears once in the legend and once on the map.
constexpr const char* kOdometryStroke = "stroke:rgb(83.5%,36.9%,0%)";

TEST_F(MapPictureFile, AnSvgIsMadeOfStrokes) {
  const std::string svg = svg_of(made_picture(), scratch("map.svg"));
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_EQ(svg.find("<image"), std::string::npos) << "pixels in a picture of strokes";
  EXPECT_NE(svg.find("width=\"1600\""), std::string::npos) << svg.substr(0, 300);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_EQ(count(svg, "stroke-dasharray"), 0U);
}

TEST_F(MapPictureFile, ALostStretchIsDashedAndInTheLegend) {
  MapPicture picture = made_picture();
  picture.estimate.push_back({{{20.0, 0.0}, {22.0, 1.0}, {25.0, 2.0}}, true});
  const std::string svg = svg_of(picture, scratch("map.svg"));
  EXPECT_EQ(count(svg, "stroke-dasharray"), 2U);
}

TEST_F(MapPictureFile, ThePathInHindsightHasAStrokeAndAnEntryOfItsOwn) {
  constexpr const char* kStroke = "stroke:rgb(80%,47.5%,65.5%)";
  MapPicture picture = made_picture();
  EXPECT_EQ(count(svg_of(picture, scratch("without.svg")), kStroke), 0U);
  picture.smoothed = {{0.0, 0.0}, {5.0, 1.0}, {19.0, 0.5}};
  EXPECT_EQ(count(svg_of(picture, scratch("with.svg")), kStroke), 2U);
}

TEST_F(MapPictureFile, EllipsesLargerThanTheViewAreNotThere) {
  MapPicture picture = made_picture();
  const std::string before = svg_of(picture, scratch("before.svg"));
  picture.poses.push_back({{12.0, 0.1}, 141.0 * 141.0 * Eigen::Matrix2d::Identity()});
  const std::string after = svg_of(picture, scratch("after.svg"));
  const std::string fill = "fill:rgb(0%,44.7%,69.8%);fill-opacity:0.1;";
  EXPECT_EQ(count(before, fill), 2U) << "one on the map, one in the legend";
  EXPECT_EQ(count(after, fill), 2U);
  EXPECT_GT(after.size(), before.size()) << "it is told";
}

TEST_F(MapPictureFile, NothingIsDrawnOutsideOfTheFrame) {
  MapPicture picture = made_picture();
  const std::size_t one = count(svg_of(picture, scratch("one.svg")), kOdometryStroke);
  EXPECT_EQ(one, 2U);
  picture.odometry.insert(picture.odometry.begin() + 10, {1e6, 2e6});  // the path leaves the frame and comes back
  EXPECT_EQ(count(svg_of(picture, scratch("two.svg")), kOdometryStroke), one + 1);
}

TEST_F(MapPictureFile, KindsHaveColoursAndEntriesOfTheirOwn) {
  MapPicture picture = made_picture();
  picture.landmarks.push_back({{{9.0, 3.0}, 0.02 * Eigen::Matrix2d::Identity()}, "8", 0, true});
  picture.kinds = {{"red", 0.0}};
  const std::string svg = svg_of(picture, scratch("map.svg"));
  const std::string plain = "fill:rgb(0%,62%,45.1%);fill-opacity:0.22;",
                    red = "fill:rgb(83.5%,36.9%,0%);fill-opacity:0.22;";
  EXPECT_EQ(count(svg, plain), 2U) << "one on the map, one in the legend";
  EXPECT_EQ(count(svg, red), 2U);
}

TEST_F(MapPictureFile, RefusesOtherEndings) {
  for (const char* name : {"map.gif", "map", "map.png.txt"}) {
    const auto problem = write_map_picture(made_picture(), scratch(name));
    ASSERT_TRUE(problem);
    EXPECT_NE(problem->find(".svg"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(scratch(name)));
  }
  EXPECT_EQ(plot_format("a/MAP.SVG"), PlotFormat::svg);
  EXPECT_EQ(plot_format("map.Pdf"), PlotFormat::pdf);
  EXPECT_FALSE(plot_format("svg"));
}

TEST_F(MapPictureFile, APdfHasOnePage) {
  ASSERT_EQ(write_map_picture(made_picture(), scratch("map.pdf")), std::nullopt);
  const std::string pdf = bytes(scratch("map.pdf"));
  EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
  EXPECT_EQ(count(pdf, "/Type /Page "), 1U);
  EXPECT_EQ(pdf.find("/CreationDate"), std::string::npos);
}

TEST_F(MapPictureFile, OfNothingIsStillAPicture) {
  EXPECT_EQ(write_map_picture(MapPicture{}, scratch("map.png")), std::nullopt);
}

TEST_F(MapPictureFile, SurvivesADivergedEstimate) {
  MapPicture picture = made_picture();
  picture.estimate[0].line[7] = {NAN, NAN};
  picture.estimate[0].line[8] = {1e300, -1e300};
  picture.odometry[3] = {INFINITY, 0.0};
  picture.landmarks.push_back({{{NAN, 1.0}, Eigen::Matrix2d::Constant(NAN)}, "9", -1, true});
  picture.poses.push_back({{3.0, 1.0}, Eigen::Matrix2d::Constant(INFINITY)});
  for (const char* name : {"map.png", "map.svg", "map.pdf"}) {
    EXPECT_EQ(write_map_picture(picture, scratch(name)), std::nullopt);
    EXPECT_GT(bytes(scratch(name)).size(), 10000U) << name;
  }
  EXPECT_EQ(bytes(scratch("map.svg")).find("nan"), std::string::npos);
}

TEST_F(MapPictureFile, SaysWhyItCannotBeWritten) {
  const auto problem = write_map_picture(made_picture(), scratch("no-such-folder") / "map.png");
  ASSERT_TRUE(problem);
  EXPECT_FALSE(problem->empty());
}

}  // namespace
}  // namespace azimuth
