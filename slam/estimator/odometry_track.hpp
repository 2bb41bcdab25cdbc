#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "slam/estimator/reading_clock.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/geometry/motion.hpp"
#include "slam/sample/odometry.hpp"
#include "slam/sample/odometry_since.hpp"

namespace azimuth {

/// The calibrated odometry as a function of time, and the motion between two instants of it.
///
/// Readings are corrected by the rig (scales, drift, lag) and joined into one continuous pose; a restarted odometer
/// (another `origin`) goes on where the last one stopped. What the odometer doubts of its motion is charged to that
/// motion, in parts when a step ends within it. Motion is accumulated in segments long enough for their
/// direction to be known, so that its noise does not depend on how often the odometer reports.
///
/// Thread contract: thread-bound; nothing allocates after construction.
class OdometryTrack {
 public:
  explicit OdometryTrack(const OdometryRig& rig);

  /// Appends a reading, stamped later than the last one. When kCapacity readings wait, the oldest is folded into the
  /// motion of the running step: from then on instants before it cannot be asked for.
  void add(const OdometryReading& reading);

  /// Before any reading: the running step has begun earlier, and came as far as `since` says. What is added next must
  /// be of the same origin.
  void go_on(const OdometrySince& since);

  static constexpr std::size_t kCapacity = 1024;

  bool empty() const { return !newest_; }
  const OdometryReading& newest_raw() const { return *raw_; }  ///< as it was added; requires !empty()
  Stamp newest() const { return newest_->stamp; }              ///< with the rig's lag; requires !empty()
  Stamp oldest() const { return passed_->stamp; }              ///< no earlier instant can be asked for

  /// The first reading at or after `stamp`, if there is one; its stamp with the rig's lag.
  std::optional<Stamp> first_from(Stamp stamp) const;

  /// Whether nobody knows how the robot went about `stamp`: the readings before and after are farther apart than
  /// `longest`, and it moved between them, or the odometer doubts that it did not. Both readings may be right to the
  /// millimetre, and a robot that turned a corner between them was not half-way.
  bool is_blind_at(Stamp stamp, Duration longest) const;

  /// Motion and odometry pose (T_odom_body, calibrated) from the end of the last step to `stamp`.
  struct Step {
    Motion motion;
    Pose2 T_odom_body;
  };
  /// Ends the running step at `stamp` (between oldest() and newest(), else clamped to them) and begins the next.
  Step advance_to(Stamp stamp);
  /// The running step up to the newest reading, without ending it.
  Step peek() const;

 private:
  struct Node {
    Stamp stamp;
    Pose2 T_odom_body;
    double gap_variance_m2 = 0.0;  // of the motion since the node before, not charged yet
    double gap_variance_rad2 = 0.0;
  };
  /// Motion up to the node `at`, of which the stretch since `segment_start` is not charged yet.
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
  std::optional<OdometryReading> raw_;  // last reading as it came
  std::optional<Node> newest_, passed_;
  Stamp passed_reading_{};                              // of the last one that was passed
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();  // where passed_ is: (m/s, m/s, rad/s), body frame
  bool is_momentary_ = false;                           // else that is a mean over a long time
  std::vector<Node> waiting_;                           // ring of readings after passed_
  std::size_t first_ = 0, count_ = 0;
  Running running_;
};

}  // namespace azimuth
