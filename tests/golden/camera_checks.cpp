#include <gtest/gtest.h>
#include <variant>

#include "slam/camera/camera_model.hpp"
#include "tests/golden/checks.hpp"

namespace azimuth::golden {
namespace {

/// Larger than the angle of any direction in the cases.
constexpr double kThetaMax_rad = 1.5;

CameraModel camera_of(const nlohmann::json& input) {
  const auto number = [&](const char* key) { return input.at(key).get<double>(); };
  const ImageAxes axes{{number("u0"), number("v0")}, number("beta"), 1, 0.0};
  return {axes, PajdlaFisheye{number("a"), number("b"), number("c"), number("d"), kThetaMax_rad}};
}

void check_profile(const PajdlaFisheye& fisheye, double theta_rad, const GoldenCase& golden, std::size_t i) {
  expect_near(fisheye.radius_at_px(theta_rad), golden.expected.at("r").at(i), golden.tolerance, "r");
  expect_near(fisheye.radius_slope_px_per_rad(theta_rad), golden.expected.at("drdtheta").at(i), golden.tolerance,
              "drdtheta");
}

/// Theta is the angle from the optical axis. The azimuth is undefined on the axis.
void check_direction(const CameraModel& camera, const Eigen::Vector2d& phi_theta, const GoldenCase& golden,
                     std::size_t i) {
  const Eigen::Vector2d expected = to_vector(golden.expected.at("uv").at(i));
  const auto pixel = camera.pixel(Direction{phi_theta.x(), kPi / 2 - phi_theta.y()});
  ASSERT_TRUE(pixel);
  expect_near(*pixel, expected, golden.tolerance, "uv");

  const auto back = camera.direction(expected);
  ASSERT_TRUE(back);
  expect_near(Eigen::Vector2d(back->azimuth_rad, kPi / 2 - back->elevation_rad),
              to_vector(golden.expected.at("inverse").at(i)), golden.tolerance, "inverse");
}

}  // namespace

void check_camera(const GoldenCase& golden) {
  const CameraModel camera = camera_of(golden.input);
  const auto& directions = golden.input.at("phi_theta");
  ASSERT_FALSE(directions.empty());
  for (std::size_t i = 0; i < directions.size(); ++i) {
    SCOPED_TRACE(i);
    const Eigen::Vector2d phi_theta = to_vector(directions.at(i));
    check_profile(std::get<PajdlaFisheye>(camera.profile()), phi_theta.y(), golden, i);
    check_direction(camera, phi_theta, golden, i);
  }
}

}  // namespace azimuth::golden
