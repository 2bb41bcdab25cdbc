#pragma once
// Crossings of a candidate's rays, and the rules by which they make it a landmark (mathematics II.8).

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

#include "slam/fastslam/lamp_view.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {

/// A detection with the pose from which it was made. `seen` is not owned.
struct Ray {
  Viewpoint from;
  const LampSighting* seen = nullptr;

  Eigen::Vector3d direction() const;  ///< Unit vector in the map
};

/// The midpoint of the shortest connection of two rays.
struct Crossing {
  Eigen::Vector3d p_map;
  double along_first_m, along_second_m;  ///< Distances of the connection's end points from the viewpoints
  double gap_m;                          ///< Length of the connection
  double angle_rad;                      ///< Angle between the rays
};
/// Returns nullopt for parallel rays.
std::optional<Crossing> crossing(const Ray& first, const Ray& second);

struct CrossingRules {
  double min_parallax_rad = 0.0;
  double gate_sigmas = 8.0;  ///< Gate on the deviation of every detection from the direction of the point
  int min_sightings = 3;
  int min_points = 5;
};

/// The crossings of a candidate's rays that agree with all its detections. Each new detection may add crossings. A
/// crossing that contradicts a detection is dropped permanently, so no crossing is tested twice.
///
/// Thread contract: reentrant. Trivially copyable, since particles copy their candidates.
class CrossPoints {
 public:
  /// `rays` must hold all rays of the candidate, the current one last.
  void observe(std::span<const Ray> rays, const CrossingRules& rules);

  std::size_t valid() const { return count_; }
  std::size_t with_current() const { return with_current_; }
  bool suffice(std::size_t sightings, const CrossingRules& rules) const {
    return sightings >= as_size(rules.min_sightings) && count_ >= as_size(rules.min_points) && with_current_ > 0;
  }
  /// The crossing with the greatest product of likelihoods. There must be one.
  const Eigen::Vector3d& best() const;

 private:
  struct Point {
    Eigen::Vector3d p_map;
    double distance2;  ///< Sum over all detections, in squared standard deviations
  };
  void drop_contradicted(const Ray& current, double gate2);
  void add(const Point& point);

  static constexpr std::size_t kMost = 16;  // When full, the worst crossing is replaced
  std::array<Point, kMost> points_;
  std::size_t count_ = 0, with_current_ = 0;
};

}  // namespace azimuth
