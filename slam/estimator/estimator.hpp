#pragma once
// The interface every estimator has: a filter today, a smoother tomorrow. Nothing outside may assume which.

#include <optional>
#include <vector>

#include "slam/ekf/camera_errors.hpp"
#include "slam/estimator/estimate.hpp"
#include "slam/estimator/past_pose.hpp"
#include "slam/estimator/rig_finding.hpp"
#include "slam/geometry/motion.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/expected_bearing.hpp"
#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// Turns motion and bearings into poses and a map.
///
/// Thread contract: thread-bound (one thread at a time may use one object). No call allocates once the map has
/// stopped growing. Same calls, same bits.
class Estimator {
 public:
  virtual ~Estimator() = default;

  /// The odometry is about to begin, and says whether it goes on from where the map was saved that the estimator starts
  /// from: then predict() brings all the motion since. Called once before anything else. True: the pose goes on from
  /// there; never for one that did not ask (MapStart::asks_odometry).
  virtual bool odometry_begins(bool /*goes_on*/) { return false; }

  /// The robot moved: advance to the instant at the end of `motion`.
  virtual void predict(const Motion& motion) = 0;

  /// Uses the bearings of the instant that predict() advanced to.
  virtual void update(const BearingSet& observations) = 0;

  /// Writes pose, covariance, landmarks, health and association counts of the present instant into `out`,
  /// reusing its storage. Leaves stamps, sequence numbers and input counts to the caller.
  virtual void estimate(Estimate& out) const = 0;

  /// Likewise after a further `motion`, without advancing to it; landmarks are left alone.
  virtual void look_ahead(const Motion& motion, Estimate& out) const = 0;

  /// Replaces what `out` holds by where mapped landmarks should be seen from the present pose, those too far away or
  /// behind something included: for people to look at. An estimator that cannot tell leaves it empty.
  virtual void expect(std::vector<ExpectedBearing>& out) const { out.clear(); }

  /// How the camera differs from its rig by now; nothing: it is exact, or nobody found out.
  virtual std::optional<CameraErrors> camera_errors() const { return std::nullopt; }

  /// What it has found out of the rig; an estimator that believes its rig has found nothing.
  virtual RigFinding rig_finding() const { return {}; }

  /// Writes what is known of the world into `out`, reusing its storage; its stamp is left to the caller. False, with
  /// `out` unspecified, when there is nothing worth keeping (no landmark yet, or the robot is lost), and always for an
  /// estimator that cannot tell.
  virtual bool save_map(MapSnapshot& /*out*/) const { return false; }

  /// Replaces what `out` holds by where the robot was at each update(), oldest first, as it is known by now. False,
  /// with `out` unspecified, for an estimator that decides at once and never again.
  virtual bool write_past(std::vector<PastPose>& /*out*/) const { return false; }

  /// Likewise the path, likeliest now, at as few instants as tell it, and without covariances: quickly done. False,
  /// with `out` unspecified, where write_past() says so.
  virtual bool write_path(std::vector<PathPose>& /*out*/) const { return false; }

  /// Nothing more will come: path and map are solved until nothing changes, however long that takes, and what is asked
  /// from then on is told by that. An estimator that decides at once and never again has nothing to add.
  virtual void conclude() {}
};

}  // namespace azimuth
