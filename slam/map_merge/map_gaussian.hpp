#pragma once
// Internal to slam/map_merge.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "slam/geometry/index.hpp"
#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// A saved map as a Gaussian, in its own frame.
struct MapGaussian {
  const MapSnapshot* map = nullptr;  ///< Not owned
  Eigen::VectorXd mean;              ///< Pose and camera, if kept, then each landmark's x, y and height
  Eigen::MatrixXd covariance;
  std::vector<Eigen::Index> row;  ///< Of each landmark: the row of its x

  std::size_t size() const { return row.size(); }
  const MapLandmark& landmark(std::size_t i) const { return map->landmarks[i]; }
  Eigen::Vector2d point(std::size_t i) const { return mean.segment<2>(row[i]); }
  Eigen::Matrix2d covariance_of(std::size_t i) const { return covariance.block<2, 2>(row[i], row[i]); }
};

enum class Kept { everything, landmarks };
MapGaussian gaussian_of(const MapSnapshot& map, Kept kept);

/// A landmark of map a and a landmark of map b that are the same.
struct Correspondence {
  std::size_t a = 0, b = 0;
  friend bool operator==(const Correspondence&, const Correspondence&) = default;
};

/// Whether identities, kinds and heights permit the pair.
bool may_be_one(const MapGaussian& a, const MapGaussian& b, const Correspondence& pair);

/// The convex hull, counter-clockwise.
std::vector<Eigen::Vector2d> hull_of(std::vector<Eigen::Vector2d> points);
double area_of(std::span<const Eigen::Vector2d> hull);
bool contains(std::span<const Eigen::Vector2d> hull, const Eigen::Vector2d& point);

std::vector<Eigen::Vector2d> points_of(const MapGaussian& map);

}  // namespace azimuth
