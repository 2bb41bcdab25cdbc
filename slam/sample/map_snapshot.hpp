#pragma once
// A map as it outlives an estimator: what is saved to disk, and what the next start begins from.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "slam/geometry/pose2.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// A symmetric matrix, of which the lower triangle is kept, column after column.
///
/// Thread contract: thread-bound. resize() allocates only beyond the largest size so far.
class PackedSymmetric {
 public:
  /// Zero everywhere.
  void resize(std::size_t size) {
    size_ = size;
    lower_.assign(packed_size(size), 0.0);
  }
  std::size_t size() const { return size_; }

  double operator()(std::size_t row, std::size_t column) const { return lower_[at(row, column)]; }
  double& operator()(std::size_t row, std::size_t column) { return lower_[at(row, column)]; }

  /// Rows `column` to the last of a column.
  std::span<double> below(std::size_t column) { return {&lower_[at(column, column)], size_ - column}; }
  std::span<const double> below(std::size_t column) const { return {&lower_[at(column, column)], size_ - column}; }

  std::span<const double> lower() const { return lower_; }
  std::span<double> lower() { return lower_; }
  static constexpr std::size_t packed_size(std::size_t size) { return size * (size + 1) / 2; }

  friend bool operator==(const PackedSymmetric&, const PackedSymmetric&) = default;

 private:
  std::size_t at(std::size_t row, std::size_t column) const {
    if (row < column) std::swap(row, column);
    return column * size_ - column * (column + 1) / 2 + row;
  }

  std::size_t size_ = 0;
  std::vector<double> lower_;
};

/// A landmark of a saved map.
struct MapLandmark {
  std::int64_t id = 0;                   ///< see LandmarkEstimate
  Identity identity = kUnknownIdentity;  ///< as MapSnapshot::names says
  Kind kind = kAnyKind;
  std::uint64_t sightings = 0;  ///< bearings accepted
  Eigen::Vector2d p_map_landmark_m = Eigen::Vector2d::Zero();
  double z_map_landmark_m = std::numeric_limits<double>::quiet_NaN();  ///< above the floor; NaN: mapped in the plane

  bool has_height() const { return z_map_landmark_m == z_map_landmark_m; }
  /// Coordinates it has in the joint covariance.
  std::size_t size() const { return has_height() ? 3 : 2; }
};

/// What a landmark looked like, and from where.
struct MapView {
  Identity identity = kUnknownIdentity;  ///< of the landmark
  Eigen::Vector2d p_map_robot_m = Eigen::Vector2d::Zero();
  Descriptor looks;
  friend bool operator==(const MapView&, const MapView&) = default;
};

/// Who gave the landmarks of a map their identities. The numbers stand in files: never change one.
enum class MapNames : std::uint8_t {
  none = 0,    ///< nobody: they are told apart by where they are
  sensor = 1,  ///< the sensor, which sees names
  looks = 2,   ///< the estimator, by what they look like: see MapSnapshot::views
};

/// What an estimator knows of the world at one instant.
struct MapSnapshot {
  Stamp stamp{};     ///< of the last step
  Pose2 T_map_body;  ///< the robot's pose then
  /// What the estimator found out about its camera, in an order of its own: another estimator, or one with other
  /// settings, has no use for it.
  std::vector<double> camera;
  std::vector<MapLandmark> landmarks;
  /// Of, one after another: the pose (x [m], y [m], heading [rad]), `camera`, and each landmark's x, y and, where it
  /// has a height, z.
  PackedSymmetric covariance;
  std::vector<MapView> views;  ///< of each landmark known by its looks, oldest first
  MapNames names = MapNames::none;
  std::int64_t next_id = 0;    ///< no landmark has had this id or a higher one
  Identity next_identity = 0;  ///< likewise, where the estimator gives the names

  static constexpr std::size_t kPoseEntries = 3;
  /// Row of the first landmark's x in `covariance`.
  std::size_t first_landmark_entry() const { return kPoseEntries + camera.size(); }
  /// Rows that `covariance` must have.
  std::size_t entries() const {
    std::size_t entries = first_landmark_entry();
    for (const MapLandmark& landmark : landmarks) entries += landmark.size();
    return entries;
  }

  /// Nothing known, storage kept.
  void clear() {
    camera.clear();
    landmarks.clear();
    covariance.resize(0);
    views.clear();
    names = MapNames::none;
    next_id = next_identity = 0;
  }
};

}  // namespace azimuth
