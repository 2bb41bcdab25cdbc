#pragma once
// Where two sightings of a candidate meet, and when they make it a landmark (SPEC II.8).

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

#include "slam/fastslam/lamp_view.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {

/// A sighting with the pose it was made from. `seen` is borrowed.
struct Ray {
  Viewpoint from;
  const LampSighting* seen = nullptr;

  Eigen::Vector3d direction() const;  ///< unit vector in the map
};

/// The midpoint of the shortest connection of two rays.
struct Crossing {
  Eigen::Vector3d p_map;
  double along_first_m, along_second_m;  ///< of its feet, from the viewpoints
  double gap_m;                          ///< its length
  double angle_rad;                      ///< between the rays
};
/// Nothing for parallel rays.
std::optional<Crossing> crossing(const Ray& first, const Ray& second);

struct CrossingRules {
  double min_parallax_rad = 0.0;
  double gate_sigmas = 8.0;  ///< every sighting must be this near to the direction of the point
  int min_sightings = 3;
  int min_points = 5;
};

/// Crossings of a candidate's rays that all its sightings agree with. Grows with every sighting; a point that a later
/// sighting contradicts is gone for good, so nothing need be tested twice.
///
/// Thread contract: reentrant. Trivially copyable: particles copy their candidates.
class CrossPoints {
 public:
  /// `rays` holds all of the candidate's, the current one last.
  void observe(std::span<const Ray> rays, const CrossingRules& rules);

  std::size_t valid() const { return count_; }
  std::size_t with_current() const { return with_current_; }
  bool suffice(std::size_t sightings, const CrossingRules& rules) const {
    return sightings >= as_size(rules.min_sightings) && count_ >= as_size(rules.min_points) && with_current_ > 0;
  }
  /// The point with the greatest product of likelihoods; there is one.
  const Eigen::Vector3d& best() const;

 private:
  struct Point {
    Eigen::Vector3d p_map;
    double distance2;  ///< summed over all sightings, in squared standard deviations
  };
  void drop_contradicted(const Ray& current, double gate2);
  void add(const Point& point);

  static constexpr std::size_t kMost = 16;  // beyond that the worst gives way
  std::array<Point, kMost> points_;
  std::size_t count_ = 0, with_current_ = 0;
};

}  // namespace azimuth
