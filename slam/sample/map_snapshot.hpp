#pragma once
// A map independent of an estimator: it is saved to disk, and the next start can begin from it.

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

/// A symmetric matrix, stored as its lower triangle, column by column.
///
/// Thread contract: thread-bound. resize() allocates only beyond the largest size so far.
class PackedSymmetric {
 public:
  /// Sets the size and all entries to zero.
  void resize(std::size_t size) {
    size_ = size;
    lower_.assign(packed_size(size), 0.0);
  }
  std::size_t size() const { return size_; }

  double operator()(std::size_t row, std::size_t column) const { return lower_[at(row, column)]; }
  double& operator()(std::size_t row, std::size_t column) { return lower_[at(row, column)]; }

  /// A column from its diagonal entry downwards.
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
  Identity identity = kUnknownIdentity;  ///< assigned as MapSnapshot::names says
  Kind kind = kAnyKind;
  std::uint64_t sightings = 0;  ///< number of accepted bearings
  Eigen::Vector2d p_map_landmark_m = Eigen::Vector2d::Zero();
  double z_map_landmark_m = std::numeric_limits<double>::quiet_NaN();  ///< above the floor; NaN: mapped in the plane

  bool has_height() const { return z_map_landmark_m == z_map_landmark_m; }
  /// Number of coordinates in the joint covariance.
  std::size_t size() const { return has_height() ? 3 : 2; }
};

/// The appearance of a landmark, and the position from which it was seen.
struct MapView {
  Identity identity = kUnknownIdentity;  ///< of the landmark
  Eigen::Vector2d p_map_robot_m = Eigen::Vector2d::Zero();
  Descriptor looks;
  friend bool operator==(const MapView&, const MapView&) = default;
};

/// The origin of the landmarks' identities in a map. The numbers are stored in files and must never change.
enum class MapNames : std::uint8_t {
  none = 0,    ///< no identities: landmarks differ by position only
  sensor = 1,  ///< the sensor
  looks = 2,   ///< the estimator, by appearance: see MapSnapshot::views
};

/// An estimator's map and pose at one instant.
struct MapSnapshot {
  Stamp stamp{};     ///< of the last step
  Pose2 T_map_body;  ///< the robot's pose then
  /// The camera calibration that the estimator found, in an order of its own. Other estimators or settings cannot use
  /// it.
  std::vector<double> camera;
  std::vector<MapLandmark> landmarks;
  /// Joint covariance of the pose (x [m], y [m], heading [rad]), then `camera`, then each landmark's x, y and, for a
  /// landmark with a height, z.
  PackedSymmetric covariance;
  std::vector<MapView> views;  ///< views of landmarks identified by appearance, oldest first
  MapNames names = MapNames::none;
  std::int64_t next_id = 0;    ///< above all ids used so far
  Identity next_identity = 0;  ///< above all identities so far, if the estimator assigns them

  static constexpr std::size_t kPoseEntries = 3;
  /// Row of the first landmark's x in `covariance`.
  std::size_t first_landmark_entry() const { return kPoseEntries + camera.size(); }
  /// Number of rows that `covariance` must have.
  std::size_t entries() const {
    std::size_t entries = first_landmark_entry();
    for (const MapLandmark& landmark : landmarks) entries += landmark.size();
    return entries;
  }

  /// Removes everything but keeps the storage.
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
