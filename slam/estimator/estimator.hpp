#pragma once
// The interface of every estimator, filter or smoother. Callers must not assume which one they use.

#include <optional>
#include <vector>

#include "slam/ekf/camera_errors.hpp"
#include "slam/estimator/estimate.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/geometry/motion.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// Computes poses and a map from motion and bearings.
///
/// Thread contract: thread-bound (one thread at a time may use one object). No call allocates once the map has stopped
/// growing. The same calls give the same results to the last bit.
class Estimator {
 public:
  virtual ~Estimator() = default;

  /// Called once, before anything else, when odometry starts. `goes_on`: the odometer kept counting since the saved map
  /// that the estimator starts from was written, so that predict() will bring all the motion since then. Returns true
  /// when the estimator keeps the saved pose because of that; never true unless MapStart::asks_odometry was set.
  virtual bool odometry_begins(bool /*goes_on*/) { return false; }

  /// The robot moved: advances to the instant at the end of `motion`.
  virtual void predict(const Motion& motion) = 0;

  /// Uses the bearings of the instant that the last predict() advanced to.
  virtual void update(const BearingSet& observations) = 0;

  /// Writes pose, covariance, landmarks, health and association counts of the present instant into `out`, reusing its
  /// storage. Leaves stamps, sequence numbers and input counts to the caller.
  virtual void estimate(Estimate& out) const = 0;

  /// Writes the same as estimate() would after a further `motion`, without advancing to it. Leaves landmarks alone.
  virtual void look_ahead(const Motion& motion, Estimate& out) const = 0;

  /// Writes the directions in which mapped landmarks should be seen from the present pose into `out`, replacing its
  /// contents. Landmarks that are too far away or occluded are included: the result is for display. An estimator that
  /// cannot predict bearings leaves `out` empty.
  virtual void expect(std::vector<ExpectedBearing>& out) const { out.clear(); }

  /// How the camera differs from its rig, as estimated so far. Nothing when the camera counts as exact or is not
  /// estimated.
  virtual std::optional<CameraErrors> camera_errors() const { return std::nullopt; }

  /// What the estimator has found out about the rig; empty for an estimator that does not estimate the rig.
  virtual RigFinding rig_finding() const { return {}; }

  /// Writes the map into `out`, reusing its storage; the caller sets its stamp. Returns false, with `out` unspecified,
  /// when there is nothing worth saving (no landmark yet, or the robot is lost), and always for an estimator that
  /// cannot save maps.
  virtual bool save_map(MapSnapshot& /*out*/) const { return false; }

  /// Writes the robot's pose at each update() into `out`, oldest first, as it is known now, replacing its contents.
  /// Returns false, with `out` unspecified, for an estimator that never revises past poses.
  virtual bool write_past(std::vector<PastPose>& /*out*/) const { return false; }

  /// Writes the most likely path into `out`, at as few instants as describe it and without covariances; this is fast.
  /// Returns false, with `out` unspecified, where write_past() does.
  virtual bool write_path(std::vector<PathPose>& /*out*/) const { return false; }

  /// No more samples will come. The estimator solves path and map until they converge, however long that takes; later
  /// calls return that solution. An estimator that never revises past poses does nothing.
  virtual void conclude() {}
};

}  // namespace azimuth
