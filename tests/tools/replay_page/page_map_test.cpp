#include "tools/replay_page/page_map.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace azimuth {
namespace {

TEST(PageNumber, RoundsToItsUnit) {
  EXPECT_EQ(page_number(1.23456, 1e-3).dump(), "1.235");
  EXPECT_EQ(page_number(-0.0001, 1e-3).dump(), "0.0");
  EXPECT_EQ(page_number(41.9999999, 1.0).dump(), "42");
  EXPECT_EQ(page_number(0.000123456789).dump(), "0.00012346");
  EXPECT_EQ(page_number(std::numeric_limits<double>::quiet_NaN()).dump(), "null");
  EXPECT_EQ(page_number(std::numeric_limits<double>::infinity(), 1e-3).dump(), "null");
}

TEST(PageMap, KeepsThoseKnownBestWhenThereAreTooMany) {
  MapPicture picture;
  for (std::size_t i = 0; i < kMostPageLandmarks + 100; ++i) {
    const double variance_m2 = 1e-4 * static_cast<double>(i + 1);
    picture.landmarks.push_back(
        {.point = {{1.0, 2.0}, variance_m2 * Eigen::Matrix2d::Identity()}, .name = std::to_string(i)});
  }
  const nlohmann::ordered_json map = page_map(picture);
  EXPECT_EQ(map["all"], kMostPageLandmarks + 100);
  ASSERT_EQ(map["landmarks"].size(), kMostPageLandmarks);
  for (const auto& landmark : map["landmarks"])
    EXPECT_LT(std::stoul(landmark["name"].get<std::string>()), kMostPageLandmarks);
}

TEST(PageMap, SaysKindAndCovariance) {
  MapPicture picture;
  picture.kinds = {{"red", 0.0}, {"blue", 240.0}};
  Eigen::Matrix2d covariance;
  covariance << 0.04, 0.01, 0.01, 0.09;
  picture.landmarks = {{.point = {{1.0, -2.5}, covariance}, .name = "7", .kind = 1, .is_known = false},
                       {.point = {{0.0, 0.0}, covariance}, .name = "8", .kind = 99, .is_known = true}};
  const nlohmann::ordered_json map = page_map(picture);
  EXPECT_EQ(map["kinds"].size(), 3u);
  EXPECT_EQ(map["landmarks"][0]["at"].dump(), "[1.0,-2.5]");
  EXPECT_EQ(map["landmarks"][0]["covariance"].dump(), "[0.04,0.01,0.09]");
  EXPECT_EQ(map["landmarks"][0]["kind"], 2);
  EXPECT_EQ(map["landmarks"][0]["settled"], false);
  EXPECT_EQ(map["landmarks"][1]["kind"], 0);
  EXPECT_EQ(map["kinds"][2]["name"], "blue");
  EXPECT_EQ(map["kinds"][2]["colour"].get<std::string>().size(), 7u);
}

TEST(PageMap, CountsLandmarksThatHaveNoNamesInTheOrderOfTheirIds) {
  MapPicture picture;
  const Eigen::Matrix2d small = 0.01 * Eigen::Matrix2d::Identity();
  picture.landmarks = {{.point = {{0.0, 0.0}, small}, .name = "113", .id = 113},
                       {.point = {{1.0, 0.0}, small}, .name = "31", .id = 31}};
  const auto unnamed = page_map(picture)["landmarks"];
  EXPECT_EQ(unnamed[0]["name"], "2");
  EXPECT_EQ(unnamed[0]["id"], 113);
  EXPECT_EQ(unnamed[1]["name"], "1");
  picture.landmarks[1].id.reset();  // its identity from the sensor is 31
  const auto named = page_map(picture)["landmarks"];
  EXPECT_EQ(named[0]["name"], "113");
  EXPECT_EQ(named[1]["name"], "31");
  EXPECT_TRUE(named[1]["id"].is_null());
}

}  // namespace
}  // namespace azimuth
