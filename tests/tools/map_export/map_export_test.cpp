#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "tests/support/random_map.hpp"
#include "tools/map_export/map_texts.hpp"

namespace azimuth {
namespace {

using Json = nlohmann::json;

TEST(MapCsv, HasALineForEachLandmarkWithItsOwnCovariance) {
  MapSnapshot map = random_map(1, {2, 1, 0, true});
  map.landmarks[1].z_map_landmark_m = std::nan("");  // a map may have landmarks with and without height
  map.landmarks[1].kind = kAnyKind;
  map.covariance.resize(map.entries());
  for (std::size_t i = 0; i < map.entries(); ++i) map.covariance(i, i) = 0.25 * static_cast<double>(i);
  map.covariance(6, 4) = 0.125;  // covariance of x and z of the first landmark
  map.landmarks[0] = {.id = 7, .kind = 2, .sightings = 31, .p_map_landmark_m = {1.5, -2.0}, .z_map_landmark_m = 3.0};
  map.landmarks[1].id = 9;
  map.landmarks[1].sightings = 4;
  map.landmarks[1].p_map_landmark_m = {0.1, 0.2};
  EXPECT_EQ(map_csv(map),
            "landmark_id,x_m,y_m,z_m,kind,identity,sightings,var_x_m2,var_y_m2,var_z_m2,cov_xy_m2,cov_xz_m2,cov_yz_m2\n"
            "7,1.5,-2,3,2,,31,1,1.25,1.5,0,0.125,0\n"
            "9,0.1,0.2,,,,4,1.75,2,,0,,\n");
}

TEST(MapGeoJson, KeepsTheMapsOwnFrameUnlessItKnowsWhereThatIs) {
  const MapSnapshot map = random_map(2, {3, 0, 0, true});
  const Json json = Json::parse(map_geojson(map, std::nullopt));
  EXPECT_EQ(json["type"], "FeatureCollection");
  EXPECT_EQ(json["azimuth:frame"]["coordinates"], "map");
  ASSERT_EQ(json["features"].size(), 4u);
  const Json& first = json["features"][0];
  EXPECT_EQ(first["id"], std::to_string(map.landmarks[0].id));
  EXPECT_EQ(first["properties"]["landmark_id"], map.landmarks[0].id);
  EXPECT_EQ(first["geometry"]["coordinates"][1], map.landmarks[0].p_map_landmark_m.y());
  EXPECT_EQ(first["geometry"]["coordinates"][2], map.landmarks[0].z_map_landmark_m);
  EXPECT_EQ(first["properties"]["covariance_m2"][2][1], map.covariance(5, 4));
  EXPECT_EQ(json["features"][3]["id"], "robot");
}

TEST(MapGeoJson, EveryFeatureHasAnIdOfItsOwnAndOfOneType) {
  const Json json = Json::parse(map_geojson(random_map(6, {5, 0, 0, false}), std::nullopt));
  std::set<std::string> ids;
  for (const Json& feature : json["features"]) {
    ASSERT_TRUE(feature["id"].is_string()) << "a program that finds numbers makes one up for the robot";
    ids.insert(feature["id"].get<std::string>());
  }
  EXPECT_EQ(ids.size(), 6U);
}

TEST(MapGeoJson, ALocalFrameIsNotTakenForWgs84) {
  const MapSnapshot map = random_map(7, {1, 0, 0, false});
  const Json local = Json::parse(map_geojson(map, std::nullopt)), placed = Json::parse(map_geojson(map, MapOrigin{}));
  ASSERT_TRUE(local.contains("crs"));
  EXPECT_TRUE(local["crs"].is_null());
  EXPECT_EQ(local["name"], "map_frame_in_metres");
  EXPECT_FALSE(placed.contains("crs"));
  EXPECT_FALSE(placed.contains("name"));
  EXPECT_EQ(placed["azimuth:frame"]["coordinates"], "WGS 84");
}

TEST(MapGeoJson, LongitudesStayWithinAHalfTurn) {
  MapSnapshot map = random_map(8, {2, 0, 0, false});
  map.landmarks[0].p_map_landmark_m = {0.0, -1000.0};  // the y axis points west, so this landmark lies in the east
  map.landmarks[1].p_map_landmark_m = {0.0, 1000.0};
  const auto longitude_deg = [&](double origin_deg, std::size_t landmark) {
    const Json json = Json::parse(map_geojson(map, MapOrigin{0.0, origin_deg, 0.0}));
    return json["features"][landmark]["geometry"]["coordinates"][0].get<double>();
  };
  EXPECT_NEAR(longitude_deg(179.999, 0), -180.0 - 0.001 + 1000.0 / 111320.0, 1e-6);
  EXPECT_NEAR(longitude_deg(179.999, 1), 179.999 - 1000.0 / 111320.0, 1e-6);
  EXPECT_NEAR(longitude_deg(-179.999, 1), 180.0 + 0.001 - 1000.0 / 111320.0, 1e-6);
}

TEST(MapGeoJson, DrawsTheEllipseOfOneStandardDeviation) {
  MapSnapshot map = random_map(3, {1, 0, 0, false});
  map.covariance(3, 3) = map.covariance(4, 4) = 0.05;  // the axes of the ellipse lie along the diagonals
  map.covariance(4, 3) = 0.04;
  const Json ellipse = Json::parse(map_geojson(map, std::nullopt))["features"][0]["properties"]["ellipse"];
  EXPECT_NEAR(ellipse["semi_major_m"].get<double>(), 0.3, 1e-9);
  EXPECT_NEAR(ellipse["semi_minor_m"].get<double>(), 0.1, 1e-9);
  EXPECT_NEAR(std::tan(ellipse["major_direction_rad"].get<double>()), 1.0, 1e-9);
}

TEST(MapGeoJson, PutsTheMapOnTheGlobe) {
  MapSnapshot map = random_map(4, {2, 0, 0, false});
  map.landmarks[0].p_map_landmark_m = {1000.0, 0.0};
  map.landmarks[1].p_map_landmark_m = {0.0, 1000.0};
  const auto coordinates = [&](const MapOrigin& origin, int feature) {
    const Json json = Json::parse(map_geojson(map, origin));
    return json["features"][static_cast<std::size_t>(feature)]["geometry"]["coordinates"];
  };
  // One degree of latitude is 110574 m long at the equator and 111132 m at 45 degrees. At 45 degrees, one degree of
  // longitude is 78847 m long.
  const MapOrigin north{0.0, 10.0, 0.0}, east{45.0, 10.0, 90.0};
  EXPECT_NEAR(coordinates(north, 0)[1].get<double>(), 1000.0 / 110574.0, 1e-7) << "x points north";
  EXPECT_NEAR(coordinates(north, 1)[0].get<double>(), 10.0 - 1000.0 / 111320.0, 1e-7) << "y points west";
  EXPECT_NEAR(coordinates(east, 0)[0].get<double>(), 10.0 + 1000.0 / 78847.0, 1e-6) << "x points east";
  EXPECT_NEAR(coordinates(east, 1)[1].get<double>(), 45.0 + 1000.0 / 111132.0, 1e-6) << "y points north";
}

TEST(MapOrigin, IsReadStrictly) {
  EXPECT_EQ(map_origin("48.5,9.25,30")->heading_deg, 30.0);
  EXPECT_EQ(map_origin("-48.5,-9.25")->longitude_deg, -9.25);
  for (const char* bad : {"", "48.5", "48.5,", "48.5,9,30,1", "48.5;9", "90,0", "0,181", "nan,0", "48.5,9 ", "x,y"})
    EXPECT_FALSE(map_origin(bad)) << bad;
}

TEST(MapSummary, CountsWhatIsThere) {
  LoadedMap loaded;
  loaded.map = random_map(5, {6, 0, 2, false});
  loaded.file = "a.azmap";
  loaded.bytes.resize(123);
  const Json json = Json::parse(map_summary_json(loaded));
  EXPECT_EQ(json["landmarks"], 6);
  EXPECT_EQ(json["views"], 12);
  EXPECT_EQ(json["known_by"], "looks");
  EXPECT_EQ(json["bytes"], 123);
  EXPECT_NE(map_summary(loaded).find(
                "landmarks   6 settled ones (a map keeps no others), 0 with height, known by looks (12 views)"),
            std::string::npos);
  loaded.map = MapSnapshot{};
  loaded.map.covariance.resize(3);
  EXPECT_EQ(Json::parse(map_summary_json(loaded))["landmarks"], 0);
}

}  // namespace
}  // namespace azimuth
