#pragma once
// One camera of each kind, with image sizes of real cameras.

#include <algorithm>
#include <gtest/gtest.h>
#include <ostream>
#include <string>
#include <vector>

#include "slam/camera/camera_model.hpp"

namespace azimuth::test {

struct NamedCamera {
  std::string name;
  CameraModel model;
  int width_px = 0;
  int height_px = 0;
  double lowest_rad = 0.0;  ///< Range of elevations that the camera certainly sees
  double highest_rad = 0.0;
};
inline std::ostream& operator<<(std::ostream& out, const NamedCamera& camera) { return out << camera.name; }

inline const HyperbolicMirror kHyperbolic{28.095, 23.4125, 1035.376};
inline const ParabolicMirror kParabolic{285.403};
inline const PajdlaFisheye kPajdla{180.0, 2.0, 60.0, 1.2, 1.6};
inline const EquidistantFisheye kEquidistant{237.85, 1.5};

/// The profile of a real fisheye camera.
inline const PolynomialFisheye kPolynomial{{-551.7655, 0.0, 8.372454e-4, -6.474789e-7, 1.235631e-9}, 1.5};

inline std::vector<NamedCamera> cameras() {
  const ImageAxes square{{511.5, 383.25}, 1.0, -1, -kPi / 2};
  const ImageAxes flat{{320.25, 250.0}, 0.93, 1, 0.4};
  return {{"hyperbolic", {square, kHyperbolic}, 1024, 768, -kPi / 2, 0.85},
          {"hyperbolic_flat", {flat, kHyperbolic}, 640, 480, -kPi / 2, 0.85},
          {"parabolic", {square, kParabolic}, 1024, 768, -kPi / 2, 1.2},
          {"pajdla", {flat, kPajdla}, 640, 480, -0.029, kPi / 2},
          {"pajdla_behind", {square, PajdlaFisheye{150.0, 2.2, 90.0, 1.3, 1.9}}, 1024, 768, -0.329, kPi / 2},
          {"equidistant", {square, kEquidistant}, 1024, 768, 0.071, kPi / 2},
          {"polynomial", {square, kPolynomial}, 1024, 768, 0.071, kPi / 2}};
}

/// Compares the Jacobian with numeric differentiation at a pixel. Returns the number of columns that it could compare.
inline int expect_jacobian_is_derivative(const CameraModel& model, const Pixel& pixel) {
  constexpr double kStep_px = 1e-4;
  const auto jacobian = model.direction_jacobian(pixel);
  int compared = 0;
  for (int column = 0; column < 2 && jacobian; ++column) {
    const Pixel step = kStep_px * Pixel::Unit(column);
    const auto before = model.direction(pixel - step), after = model.direction(pixel + step);
    if (!before || !after) continue;
    const Eigen::Vector2d numeric{wrap(after->azimuth_rad - before->azimuth_rad) / (2 * kStep_px),
                                  (after->elevation_rad - before->elevation_rad) / (2 * kStep_px)};
    EXPECT_NEAR((jacobian->col(column) - numeric).norm(), 0.0, 1e-6 * std::max(1.0, numeric.norm()))
        << pixel.transpose();
    ++compared;
  }
  return compared;
}

}  // namespace azimuth::test
