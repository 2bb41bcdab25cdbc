// Directions of a camera whose image centre and tilt differ from its rig.

#include "slam/estimator/lamp_directions.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "slam/camera/make_camera.hpp"
#include "tests/geometry/numeric_jacobian.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

Rig ceiling_rig(const CameraTilt& tilt) {
  Rig rig;
  rig.front_end = FrontEnd::lamps;
  rig.camera.model = EquidistantRig{.focal_length_px = 240.0};
  rig.camera.image.centre_px = {384.0, 384.0};
  rig.camera.image.theta_max_rad = 1.5;
  rig.camera.image.azimuth_offset_rad = -1.2;
  rig.camera.yaw_offset_rad = 0.4;
  rig.camera.roll_rad = tilt.roll_rad;
  rig.camera.pitch_rad = tilt.pitch_rad;
  return rig;
}

Bearing bearing_at(double azimuth_rad, double zenith_rad) {
  return {.azimuth_rad = azimuth_rad,
          .elevation_rad = kPi / 2.0 - zenith_rad,
          .sigma_rad = 0.002,
          .sigma_elevation_rad = 0.002};
}

/// The unit vector of the direction in `seen`.
Eigen::Vector3d towards(const LampSeen& seen) {
  const Eigen::Vector2d m = seen.direction.offset_per_metre();
  return Eigen::Vector3d(m.x(), m.y(), 1.0).normalized();
}

TEST(LampDirections, MoveByTheCamerasErrorsAsTheySay) {
  RandomDraws draws(3);
  for (const CameraTilt& tilt : {CameraTilt{}, CameraTilt{0.03, -0.1}}) {
    const LampDirections directions(ceiling_rig(tilt));
    for (const double size : {0.0, 1e-4, 1.0}) {
      for (int i = 0; i < 100; ++i) {
        const Bearing bearing = bearing_at(draws.uniform(-kPi, kPi), draws.uniform(0.15, 1.2));
        const Eigen::Vector4d errors = size * Eigen::Vector4d(draws.uniform(-8.0, 8.0), draws.uniform(-8.0, 8.0),
                                                              draws.uniform(-0.04, 0.04), draws.uniform(-0.04, 0.04));
        const LampSeen seen = directions.seen(bearing, errors);
        const Eigen::Vector3d here = towards(seen);
        const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(here).normalized(), along = across.cross(here);
        const auto place = [&](const Eigen::VectorXd& at) {
          const Eigen::Vector3d there = towards(directions.seen(bearing, at));
          return Eigen::VectorXd(Eigen::Vector2d(across.dot(there), along.dot(there)));
        };
        EXPECT_LT(largest_difference(seen.by_camera, numeric_jacobian(place, errors, {}, 1e-4)), kJacobianTolerance);
      }
    }
  }
}

/// Correcting an estimated tilt error gives the same directions as a rig with the right tilt.
TEST(LampDirections, OfATiltFoundAreThoseOfATiltTold) {
  const CameraTilt told{0.01, 0.02}, found{0.015, -0.01};
  const Rig knows = ceiling_rig({told.roll_rad + found.roll_rad, told.pitch_rad + found.pitch_rad});
  const LampDirections by_rig(knows), by_filter(ceiling_rig(told));
  std::string problem;
  const auto looks = camera_of(ceiling_rig(told).camera, problem), is = camera_of(knows.camera, problem);
  const Eigen::Vector4d errors(0.0, 0.0, found.roll_rad, found.pitch_rad);
  for (const Pixel& pixel : {Pixel(300.0, 420.0), Pixel(384.0, 384.0), Pixel(600.0, 200.0)}) {
    const Direction shown = *looks->direction(pixel), true_direction = *is->direction(pixel);
    const LampSeen a = by_filter.seen(bearing_at(shown.azimuth_rad, kPi / 2.0 - shown.elevation_rad), errors);
    const LampSeen b = by_rig.seen(bearing_at(true_direction.azimuth_rad, kPi / 2.0 - true_direction.elevation_rad),
                                   Eigen::Vector4d::Zero());
    EXPECT_LT((towards(a) - towards(b)).norm(), 1e-12);
    const double yaw_rad = knows.camera.yaw_offset_rad;
    const Direction again =
        by_filter.shown({true_direction.azimuth_rad + yaw_rad, true_direction.elevation_rad}, errors);
    EXPECT_NEAR(again.azimuth_rad, shown.azimuth_rad, 1e-9);
    EXPECT_NEAR(again.elevation_rad, shown.elevation_rad, 1e-9);
  }
}

}  // namespace
}  // namespace azimuth
