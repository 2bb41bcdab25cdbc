#include "tools/plot/map_picture.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <system_error>

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
  for (int i = 0; i <= 20; ++i) {
    picture.estimate.emplace_back(i, std::sin(0.3 * i));
    picture.odometry.emplace_back(i, std::sin(0.3 * i) + 0.05 * i);
  }
  picture.truth = {picture.estimate};
  picture.poses = {{{10.0, 0.1}, 0.01 * Eigen::Matrix2d::Identity()}};
  picture.landmarks = {{{5.0, 3.0}, 0.02 * Eigen::Matrix2d::Identity()}};
  picture.true_landmarks = {{5.1, 3.0}};
  picture.T_map_body = Pose2{20.0, 0.0, 0.4};
  return picture;
}

class MapPictureFile : public testing::Test {
 protected:
  MapPictureFile() {
    std::string pattern = (std::filesystem::temp_directory_path() / "azimuth-test-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~MapPictureFile() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  std::filesystem::path scratch(const std::string& name) const { return folder_ / name; }

 private:
  std::filesystem::path folder_;
};

TEST_F(MapPictureFile, IsAPng) {
  const auto file = scratch("map.png");
  ASSERT_EQ(write_png(made_picture(), file.string()), std::nullopt);
  const std::string png = bytes(file);
  ASSERT_GT(png.size(), 10000u);
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  const auto width = (static_cast<unsigned char>(png[18]) << 8) + static_cast<unsigned char>(png[19]);
  EXPECT_EQ(width, 1600);
}

TEST_F(MapPictureFile, IsTheSameEachTime) {
  const auto first = scratch("first.png"), second = scratch("second.png");
  ASSERT_EQ(write_png(made_picture(), first.string()), std::nullopt);
  ASSERT_EQ(write_png(made_picture(), second.string()), std::nullopt);
  EXPECT_EQ(bytes(first), bytes(second));
}

TEST_F(MapPictureFile, OfNothingIsStillAPicture) {
  EXPECT_EQ(write_png(MapPicture{}, scratch("map.png").string()), std::nullopt);
}

TEST_F(MapPictureFile, SurvivesADivergedEstimate) {
  MapPicture picture = made_picture();
  picture.estimate[7] = {NAN, NAN};
  picture.estimate[8] = {1e300, -1e300};
  picture.odometry[3] = {INFINITY, 0.0};
  picture.landmarks.push_back({{NAN, 1.0}, Eigen::Matrix2d::Constant(NAN)});
  EXPECT_EQ(write_png(picture, scratch("map.png").string()), std::nullopt);
}

TEST_F(MapPictureFile, SaysWhyItCannotBeWritten) {
  const auto problem = write_png(made_picture(), scratch("no-such-folder").string() + "/map.png");
  ASSERT_TRUE(problem);
  EXPECT_FALSE(problem->empty());
}

}  // namespace
}  // namespace azimuth
