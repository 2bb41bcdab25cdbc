#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "slam/estimator/reading_clock.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/geometry/motion.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// The calibrated odometry as a function of time, and the motion between two of its instants.
///
/// Readings are corrected by the rig (scales, drift, lag) and joined into one continuous pose. After a restart of the
/// odometer (another `origin`) the pose continues from where it stopped. The gap variances that a reading carries are
/// added to the noise of its motion, in proportion when a step ends within that motion. Motion is accumulated in
/// segments long enough for their direction to be known, so that its noise does not depend on how often the odometer
/// reports.
///
/// Thread contract: thread-bound; nothing allocates after construction.
class OdometryTrack {
 public:
  explicit OdometryTrack(const OdometryRig& rig);

  /// Appends a reading, stamped later than the last one. When kCapacity readings wait, the oldest is folded into the
  /// motion of the running step; earlier instants can then no longer be asked for.
  void add(const OdometryReading& reading);

  /// To be called before any reading: the running step began earlier, and `since` holds its motion so far. The next
  /// reading must have the same origin.
  void go_on(const OdometrySince& since);

  static constexpr std::size_t kCapacity = 1024;

  bool empty() const { return !newest_; }
  const OdometryReading& newest_raw() const { return *raw_; }  ///< Newest reading as added; requires !empty()
  Stamp newest() const { return newest_->stamp; }              ///< Includes the rig's lag; requires !empty()
  Stamp oldest() const { return passed_->stamp; }              ///< No earlier instant can be asked for

  /// The stamp, rig's lag included, of the first reading at or after `stamp`, if there is one.
  std::optional<Stamp> first_from(Stamp stamp) const;

  /// Whether the robot's pose at `stamp` cannot be interpolated: the readings before and after are farther apart than
  /// `longest`, and the robot moved between them or the later reading carries gap variances. A robot that turned a
  /// corner between two exact readings was not half-way between them.
  bool is_blind_at(Stamp stamp, Duration longest) const;

  /// Motion from the end of the last step to `stamp`, and the calibrated odometry pose (T_odom_body) there.
  struct Step {
    Motion motion;
    Pose2 T_odom_body;
  };
  /// Ends the running step at `stamp`, clamped to oldest() and newest(), and starts the next one.
  Step advance_to(Stamp stamp);
  /// The running step up to the newest reading, without ending it.
  Step peek() const;

 private:
  struct Node {
    Stamp stamp;
    Pose2 T_odom_body;
    double gap_variance_m2 = 0.0;  // variances of the motion since the node before, without the part already charged
    double gap_variance_rad2 = 0.0;
  };
  /// Motion up to the present node; the noise of the stretch since `segment_start` is not charged yet.
  struct Running {
    Motion motion;
    Pose2 segment_start;
  };
  void pass(const Node& node);
  void note_velocity(const Node& next);
  static void charge_gap(Running& running, const Node& node, double fraction);
  void extend(Running& running, const Pose2& T_odom_body) const;
  void close_segment(Running& running, const Pose2& T_odom_body) const;
  std::size_t index(std::size_t i) const { return (first_ + i) % kCapacity; }

  MotionNoise noise_;
  OdometryRig rig_;
  ReadingClock clock_;
  std::optional<OdometryReading> raw_;  // newest reading as it was added
  std::optional<Node> newest_, passed_;
  Stamp passed_reading_{};                              // stamp of the last reading that was passed
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();  // velocity at passed_: (m/s, m/s, rad/s), body frame
  bool is_momentary_ = false;                           // false: velocity_ is a mean over a long time
  std::vector<Node> waiting_;                           // ring of readings after passed_
  std::size_t first_ = 0, count_ = 0;
  Running running_;
};

}  // namespace azimuth
