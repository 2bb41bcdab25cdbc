#include "slam/perception/lamps/ceiling_patch.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr double kLowest_rad = 0.02;  // Nearer to the horizon, a pixel covers too large a part of the ceiling

struct CeilingPoint {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< Along the robot's axes, in ceiling heights
  double pixel_area = 0.0;                       ///< Ceiling area that one pixel covers there
};

std::optional<CeilingPoint> ceiling_point(const CameraModel& camera, const Pixel& pixel) {
  const auto direction = camera.direction(pixel);
  if (!direction || direction->elevation_rad < kLowest_rad) return std::nullopt;
  const auto jacobian = camera.direction_jacobian(pixel);
  const double sine = std::sin(direction->elevation_rad), cosine = std::cos(direction->elevation_rad);
  const double distance = cosine / sine;
  // The solid angle of the pixel, then the ceiling area that subtends it: dA = dOmega / sin^3. The bound on the cosine
  // handles the zenith.
  const double solid_angle = std::abs(jacobian->determinant()) * std::max(cosine, 1e-9);
  return CeilingPoint{{distance * std::cos(direction->azimuth_rad), distance * std::sin(direction->azimuth_rad)},
                      solid_angle / (sine * sine * sine)};
}

using Points = std::array<CeilingPoint, 4>;

/// Four points on the axes of the spread, sqrt(2) standard deviations from the centroid: they have the spread's
/// covariance.
std::optional<Points> sample(const CameraModel& camera, const Pixel& centroid, const Eigen::Matrix2d& spread_px2) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
  axes.computeDirect(spread_px2);
  Points points;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto axis = as_index(k / 2);
    const double length_px = std::sqrt(2.0 * std::max(axes.eigenvalues()[axis], 0.0)) * (k % 2 == 0 ? 1.0 : -1.0);
    const auto point = ceiling_point(camera, centroid + length_px * axes.eigenvectors().col(axis));
    if (!point) return std::nullopt;
    points[k] = *point;
  }
  return points;
}

}  // namespace

std::optional<CeilingPatch> ceiling_patch(const CameraModel& camera, const Pixel& centroid,
                                          const Eigen::Matrix2d& spread_px2) {
  const auto points = sample(camera, centroid, spread_px2);
  if (!points) return std::nullopt;
  double area = 0.0;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const CeilingPoint& point : *points) {
    area += point.pixel_area;
    middle += point.pixel_area * point.at;
  }
  middle /= area;
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  for (const CeilingPoint& point : *points)
    moments += point.pixel_area / area * (point.at - middle) * (point.at - middle).transpose();

  const auto pixel = camera.pixel(Eigen::Vector3d(middle.x(), middle.y(), 1.0));
  if (!pixel) return std::nullopt;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
  axes.computeDirect(moments, Eigen::EigenvaluesOnly);
  // A rectangle with sides a and b has moments a^2 / 12 and b^2 / 12.
  const Eigen::Array2d sides = (12.0 * axes.eigenvalues().array().max(0.0)).sqrt();
  return CeilingPatch{*pixel, sides[1], sides[0] * sides[1]};
}

}  // namespace azimuth
