#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <optional>

#include "slam/geometry/motion.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// Minimum noise that is added to a motion, as standard deviations after one second of motion. The values must be
/// positive, so that the covariance between two poses is positive definite.
struct MotionFloors {
  double distance_m = 0.5e-3;
  double rotation_rad = 0.5e-3;
};

/// The motion since the newest pose of a graph, accumulated image by image. The next pose is added with it.
///
/// Thread contract: thread-bound.
class MotionSincePose {
 public:
  explicit MotionSincePose(const MotionFloors& floors) : floors_(floors) {}

  void append_motion(const Motion& motion) {
    append(motion_, motion);
    moved_ = moved_ || motion.moved();
  }
  /// Notes that an image was taken. The time since the image before counts as time in motion if the robot moved in it.
  void image_taken(Stamp stamp) {
    if (moved_ && last_image_) moving_s_ += to_seconds(stamp - *last_image_);
    last_image_ = stamp;
    moved_ = false;
  }
  /// Starts anew from a pose that the graph now has here.
  void pose_added() {
    motion_ = Motion{};
    moving_s_ = 0.0;
  }

  /// Replaces the motion since the pose by one that contains the floors.
  void restart(const Motion& motion) {
    motion_ = motion;
    moving_s_ = 0.0;
  }

  const Motion& motion() const { return motion_; }
  Motion with_floors() const {
    Motion motion = motion_;
    const double distance_m2 = floors_.distance_m * floors_.distance_m;
    const double rotation_rad2 = floors_.rotation_rad * floors_.rotation_rad;
    motion.covariance.diagonal() +=
        std::max(moving_s_, kShortest_s) * Eigen::Vector3d(distance_m2, distance_m2, rotation_rad2);
    return motion;
  }

 private:
  static constexpr double kShortest_s = 1e-3;  // for motion before the first image, whose duration is unknown

  MotionFloors floors_;
  Motion motion_;
  double moving_s_ = 0.0;  // time in motion
  bool moved_ = false;     // since the last image
  std::optional<Stamp> last_image_;
};

}  // namespace azimuth
