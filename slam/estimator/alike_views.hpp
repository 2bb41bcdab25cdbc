#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace azimuth {

/// Sightings of a lamp in a row that are in nearly the same direction from the robot: what a linear update leaves out
/// of them is the same error each time.
///
/// Thread contract: thread-bound.
class AlikeViews {
 public:
  static constexpr double kAlike_rad = 0.5;
  /// A robot that stood for long must not be deaf when it drives on.
  static constexpr int kMost = 30;

  /// How many there are by now, the sighting towards this unit vector of the robot's frame included.
  int add(const Eigen::Vector3d& towards) {
    const bool alike = count_ > 0 && towards.dot(first_) > std::cos(kAlike_rad);
    if (!alike) first_ = towards;
    return count_ = alike ? std::min(count_ + 1, kMost) : 1;
  }

 private:
  Eigen::Vector3d first_ = Eigen::Vector3d::Zero();
  int count_ = 0;
};

}  // namespace azimuth
