#pragma once
#include <Eigen/Core>
#include <map>

#include "slam/geometry/motion.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/smoother/motion_since_pose.hpp"
#include "slam/smoother/smoother.hpp"

namespace azimuth {

/// How a run of named landmarks becomes a graph.
struct KnownNamesSettings {
  SmootherSettings smoother;
  double sigma_bearing_rad = 0.0262;  ///< of bearings that say none of their own
  /// Bearings of one landmark within this time share most of their error: one of them is used (SPEC part V).
  double thinning_s = 0.5;
  MotionFloors floors;
};

/// A smoother that is told which landmark each bearing is of: one pose for each image that tells something new.
///
/// Thread contract: thread-bound. Same calls, same bits.
class KnownNames {
 public:
  explicit KnownNames(const KnownNamesSettings& settings);

  /// The robot moved, before the next update().
  void predict(const Motion& motion);
  /// The bearings of the instant that predict() led to; those without a name are passed over. True: they made a new
  /// pose, or added to the newest one, and everything was solved anew.
  bool update(const BearingSet& set);

  /// Of the last image, by all up to it. Covariance of (x, y, heading), in the map: relative to the first pose.
  Pose2 pose() const;
  Eigen::Matrix3d covariance() const;
  /// The pose in the graph that the last image's lies behind, and how: with that, an image's pose can be told anew when
  /// the graph's poses have moved.
  PoseId anchor() const { return smoother_.graph().poses() - 1; }
  const Motion& since_anchor() const { return motion_.motion(); }

  const Smoother& smoother() const { return smoother_; }
  const Smoother::Outcome& last_outcome() const { return outcome_; }

 private:
  struct Known {
    LandmarkId landmark;
    Stamp last_used;
  };
  bool is_used(const Bearing& bearing, Stamp stamp) const;

  KnownNamesSettings settings_;
  Smoother smoother_;
  Smoother::Outcome outcome_;
  MotionSincePose motion_;
  std::map<Identity, Known> known_;
};

}  // namespace azimuth
