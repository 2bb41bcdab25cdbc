#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/export/sample.hpp"
#include "tools/export/text_exports.hpp"

namespace azimuth::test {
namespace {

using Json = nlohmann::json;

TEST(PathGeoJson, HoldsThePathAndEachLandmark) {
  const Json json = Json::parse(path_geojson(sample(), std::nullopt));
  EXPECT_EQ(json["type"], "FeatureCollection");
  EXPECT_TRUE(json["crs"].is_null());
  EXPECT_EQ(json["azimuth:frame"]["coordinates"], "map");
  ASSERT_EQ(json["features"].size(), 4u);
  const Json& path = json["features"][0];
  EXPECT_EQ(path["id"], "path");
  EXPECT_EQ(path["geometry"]["type"], "LineString");
  ASSERT_EQ(path["geometry"]["coordinates"].size(), 80u);
  EXPECT_EQ(path["geometry"]["coordinates"][10][0], sample_pose(10).T_map_body.x_m);
  EXPECT_EQ(path["geometry"]["coordinates"][10].size(), 2u);
  EXPECT_EQ(path["properties"]["utimes"][10], kSampleBegin_us + 1'000'000);
  EXPECT_EQ(json["features"][1]["properties"]["identity"], 42);
  EXPECT_EQ(json["features"][1]["geometry"]["coordinates"].size(), 2u);
  EXPECT_EQ(json["features"][2]["geometry"]["coordinates"][2], 2.5) << "its height";
  EXPECT_EQ(json["features"][2]["properties"]["sigma_z_m"], 0.25);
  EXPECT_NEAR(json["features"][1]["properties"]["ellipse"]["semi_major_m"].get<double>(), 0.3, 1e-9);
}

TEST(PathGeoJson, TakesThePathOfHindsight) {
  Estimated estimated = sample();
  estimated.path = {{stamp_from_us(1), {7.0, 8.0, 0.0}}, {stamp_from_us(2), {9.0, 8.0, 0.0}}};
  const Json json = Json::parse(path_geojson(estimated, std::nullopt));
  EXPECT_EQ(json["features"][0]["geometry"]["coordinates"], Json::parse("[[7.0,8.0],[9.0,8.0]]"));
}

TEST(PathGeoJson, OfOnePoseIsALineStill) {
  const Json json = Json::parse(path_geojson(sample(1), std::nullopt));
  EXPECT_EQ(json["features"][0]["geometry"]["coordinates"].size(), 2u) << "RFC 7946 asks for two at least";
}

TEST(PathGeoJson, LiesOnTheGlobeWhereItIsKnown) {
  const Json json = Json::parse(path_geojson(sample(), MapOrigin{45.0, 10.0, 90.0}));
  EXPECT_FALSE(json.contains("crs"));
  const Json& place = json["features"][0]["geometry"]["coordinates"][10];
  EXPECT_NEAR(place[0].get<double>(), 10.0 + sample_pose(10).T_map_body.x_m / 78847.0, 1e-7) << "x points east";
  EXPECT_NEAR(place[1].get<double>(), 45.0 + sample_pose(10).T_map_body.y_m / 111132.0, 1e-7);
}

TEST(PathGeoJson, IsCutAtTheAntimeridian) {
  Estimated estimated = sample();
  estimated.path.clear();
  for (int i = 0; i < 6; ++i) estimated.path.push_back({stamp_from_us(i), {0.0, 300.0 * i, 0.0}});  // y is west
  const Json json = Json::parse(path_geojson(estimated, MapOrigin{0.0, -179.99, 0.0}));
  const Json& geometry = json["features"][0]["geometry"];
  ASSERT_EQ(geometry["type"], "MultiLineString");
  ASSERT_EQ(geometry["coordinates"].size(), 2u);
  EXPECT_EQ(geometry["coordinates"][0].size() + geometry["coordinates"][1].size(), 6u);
  EXPECT_GT(geometry["coordinates"][1][0][0].get<double>(), 179.9);
}

}  // namespace
}  // namespace azimuth::test
