#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/geometry/pose2.hpp"

namespace azimuth {

/// A point of a trail.
struct TrailPoint {
  double t_s = 0.0;   ///< time since the start of the shown period [s]
  Pose2 T_map_body;   ///< for a trail of truth: T_world_body
  Pose2 T_odom_body;  ///< not used for a trail of truth
  float sigma_m = 0.0F, sigma_heading_rad = 0.0F;
  std::uint8_t health = 0;  ///< as in pose_cov_t
};

/// The path of the robot with at most `most` points. When there are too many points, every other one is removed and the
/// spacing is doubled. The last point is always present.
///
/// Thread contract: thread-bound.
class Trail {
 public:
  explicit Trail(std::size_t most) : most_(most) {}

  /// Adds a point. It replaces the last point as long as it is closer than the spacing to the last but one. An older
  /// point is inserted in order.
  void add(const TrailPoint& point);
  void clear();

  /// The points in order of time.
  std::span<const TrailPoint> points() const { return points_; }
  /// The first points newer than `t_s`, at most `count`.
  std::span<const TrailPoint> after(double t_s, std::size_t count) const;

 private:
  bool is_apart(const TrailPoint& from, const TrailPoint& to) const;
  void thin();

  std::size_t most_;
  double apart_m_ = 0.01, apart_rad_ = 0.01, apart_s_ = 1.0;
  std::vector<TrailPoint> points_;
};

}  // namespace azimuth
