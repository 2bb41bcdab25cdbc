#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/geometry/pose2.hpp"

namespace azimuth {

/// A point of the way, in seconds since the time at which what is shown begins.
struct TrailPoint {
  double t_s = 0.0;
  Pose2 T_map_body;   ///< of the truth: T_world_body
  Pose2 T_odom_body;  ///< of the truth: nothing
  float sigma_m = 0.0F, sigma_heading_rad = 0.0F;
  std::uint8_t health = 0;  ///< as pose_cov_t has it
};

/// Where the robot has been, in at most `most` points however long it drives: where they become too many, every other
/// one goes, and from then on they are twice as far from each other. The last one is always there.
///
/// Thread contract: thread-bound.
class Trail {
 public:
  explicit Trail(std::size_t most) : most_(most) {}

  /// A point that is little newer than the last one and near to it takes its place; one that is older goes where it
  /// belongs.
  void add(const TrailPoint& point);
  void clear();

  /// In the order of their times.
  std::span<const TrailPoint> points() const { return points_; }
  /// The first ones that are newer, at most `count`.
  std::span<const TrailPoint> after(double t_s, std::size_t count) const;

 private:
  bool is_apart(const TrailPoint& from, const TrailPoint& to) const;
  void thin();

  std::size_t most_;
  double apart_m_ = 0.01, apart_rad_ = 0.01, apart_s_ = 1.0;
  std::vector<TrailPoint> points_;
};

}  // namespace azimuth
