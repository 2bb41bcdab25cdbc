#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "slam/geometry/motion.hpp"
#include "slam/hypotheses/beam.hpp"
#include "slam/hypotheses/trust.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/smoother/motion_since_pose.hpp"

namespace azimuth {

struct NamelessSettings {
  BeamSettings beam;
  /// Images nearer in time than this share most of their errors: one of them is used (SPEC part V).
  double thinning_s = 0.4;
  /// But for those of a robot that has come this far: it sees things from elsewhere.
  double far_m = 0.3;
  MotionFloors floors;
  /// Standard deviations of what is left unknown of the odometer's scales, relative.
  double sigma_scale_distance = 0.01, sigma_scale_turn = 0.01;
};

/// Path and map of a robot that sees landmarks all alike: odometry and images go in, one pose for each image that is
/// used. Names that bearings have are not looked at.
///
/// Thread contract: thread-bound; work is spread as `workers` do. Same calls, same bits, whatever the workers.
class Nameless {
 public:
  explicit Nameless(const NamelessSettings& settings);

  /// The robot moved, before the next update().
  void predict(const Motion& motion);
  /// The bearings of the instant that predict() led to. True: they made a new pose.
  bool update(const BearingSet& set, Workers& workers);

  /// Of the last image, by all up to it. Covariance of (x, y, heading), in the map: relative to the first pose. All
  /// members may be wrong: the covariance is of a mixture with what odometry alone says.
  Beam::PoseBelief pose() const;
  /// Whether that can be relied on, and what says so.
  Trust trust() const { return azimuth::trust(evidence_); }
  const TrustEvidence& evidence() const { return evidence_; }
  /// Where the robot is if no bearing is believed.
  Beam::PoseBelief odometry_alone() const;
  /// The pose in the graphs that the last image's lies behind, and how.
  PoseId anchor() const { return beam_.images() - 1; }
  const Motion& since_anchor() const { return motion_.motion(); }
  Motion since_anchor_with_floors() const { return motion_.with_floors(); }

  const Beam& beam() const { return beam_; }

 private:
  bool is_used(const BearingSet& set) const;

  NamelessSettings settings_;
  Beam beam_;
  MotionSincePose motion_, whole_motion_;
  TrustEvidence evidence_;
  std::optional<Stamp> last_used_;
  std::vector<Sighting> sightings_;
};

}  // namespace azimuth
