// The reference values of kind "camera" in tests/golden: forwards, slope and inverse of the fisheye (SPEC II.2).

#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "slam/camera/camera_model.hpp"

namespace azimuth {
namespace {

using Json = nlohmann::json;

CameraModel camera_of(const Json& input) {
  const auto number = [&](const char* key) { return input.at(key).get<double>(); };
  const ImageAxes axes{{number("u0"), number("v0")}, number("beta"), 1, 0.0};
  return {axes, PajdlaFisheye{number("a"), number("b"), number("c"), number("d"), 1.5}};
}

void check_point(const CameraModel& camera, const Json& expected, std::size_t i, const Direction& sent, double tol) {
  const auto& fisheye = std::get<PajdlaFisheye>(camera.profile());
  const double theta = kPi / 2 - sent.elevation_rad;
  EXPECT_NEAR(fisheye.radius_at_px(theta), expected["r"][i], tol * 100);
  EXPECT_NEAR(fisheye.radius_slope_px_per_rad(theta), expected["drdtheta"][i], tol * 100);

  const auto pixel = camera.pixel(sent);
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), expected["uv"][i][0], tol * 100);
  EXPECT_NEAR(pixel->y(), expected["uv"][i][1], tol * 100);

  const auto back = camera.direction({expected["uv"][i][0].get<double>(), expected["uv"][i][1].get<double>()});
  ASSERT_TRUE(back);
  EXPECT_NEAR(kPi / 2 - back->elevation_rad, expected["inverse"][i][1], tol);
  EXPECT_NEAR(back->azimuth_rad, expected["inverse"][i][0], tol);
}

TEST(GoldenCamera, AgreesWithTheReference) {
  std::ifstream file(AZIMUTH_GOLDEN_FILE);
  const Json golden = Json::parse(file);
  int points = 0;
  for (const Json& item : golden.at("cases")) {
    if (item.at("kind") != "camera") continue;
    SCOPED_TRACE(item.at("name").get<std::string>());
    const CameraModel camera = camera_of(item.at("input"));
    const Json& sent = item.at("input").at("phi_theta");
    for (std::size_t i = 0; i < sent.size(); ++i, ++points) {
      const Direction direction{sent[i][0], kPi / 2 - sent[i][1].get<double>()};
      check_point(camera, item.at("expected"), i, direction, item.at("tol"));
    }
  }
  EXPECT_EQ(points, 10);
}

}  // namespace
}  // namespace azimuth
