#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "slam/geometry/motion.hpp"
#include "slam/hypotheses/beam.hpp"
#include "slam/hypotheses/drawn_maps.hpp"
#include "slam/hypotheses/trust.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/smoother/keyframe_limit.hpp"
#include "slam/smoother/motion_since_pose.hpp"
#include "slam/smoother/thinned_path.hpp"

namespace azimuth {

struct NamelessSettings {
  BeamSettings beam;
  /// Through a narrow view maps that are drawn tell where the robot is; the beam goes on to tell where it was.
  DrawnMapsSettings drawn;
  /// Images nearer in time than this share most of their errors: one of them is used (SPEC part V).
  double thinning_s = 0.4;
  /// But for those of a robot that has come this far: it sees things from elsewhere.
  double far_m = 0.3;
  /// Of more images with bearings those that are worth least should be forgotten (SPEC VI.24); 0: none.
  int max_keyframes = 0;
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

  /// Begins from a saved map, before anything else, with the robot where the map saw it last, give or take `moved`
  /// (covariance of (x, y, heading) in the map).
  void remember(const MapSnapshot& map, const Eigen::Matrix3d& moved);
  /// The robot moved, before the next update().
  void predict(const Motion& motion);
  /// The robot is here, whatever odometry has said since the last image.
  void place(const Beam::PoseBelief& robot);
  /// The bearings of the instant that predict() led to. True: they made a new pose.
  bool update(const BearingSet& set, Workers& workers);

  /// Whether there are more images than there may be: forget() is to follow.
  bool is_full() const { return limit_.is_exceeded(beam_.best().graph()); }
  /// Those worth least to the likeliest member are forgotten by all, unless landmarks need them.
  void forget(Workers& workers);

  /// Of the last image, by all up to it. Covariance of (x, y, heading), in the map: relative to the first pose. By
  /// drawn maps where there are any; else by the beam, all of which may be wrong: of a mixture with what odometry alone
  /// says.
  Beam::PoseBelief pose() const;
  /// Whether that can be relied on, and what says so.
  Trust trust() const { return azimuth::trust(evidence_, recent_doubts_); }
  const TrustEvidence& evidence() const { return evidence_; }
  /// Where the robot is if no bearing is believed.
  Beam::PoseBelief odometry_alone() const;
  /// What is known by now of the pose of any image that was used: by the beam, in a mixture with what drawn maps said
  /// at the time where there are any, else with odometry alone. Covariance as above.
  Beam::PoseBelief past(PoseNumber number) const;
  /// The pose that the last image's lies behind, and how; -1 before the first one.
  PoseNumber anchor() const { return has_begun() ? path_.newest() : -1; }
  /// Of the poses that the graphs have.
  const std::vector<PoseNumber>& numbers() const { return path_.numbers(); }
  /// Bearings in the order of arrival, for ever: what graphs call them changes when they forget some.
  std::int64_t number_of(BearingId id) const { return bearing_numbers_[static_cast<std::size_t>(id)]; }
  /// Not forgotten.
  bool has(std::int64_t number) const { return std::ranges::binary_search(bearing_numbers_, number); }
  std::int64_t bearings_so_far() const { return bearings_so_far_; }

  const Motion& since_anchor() const { return motion_.motion(); }
  Motion since_anchor_with_floors() const { return motion_.with_floors(); }

  const Beam& beam() const { return beam_; }

 private:
  bool has_begun() const { return beam_.images() > 0; }
  bool is_used(const BearingSet& set) const;
  Motion way_to_image() const;
  Beam::PoseBelief since_image(Beam::PoseBelief belief) const;
  bool is_drawn() const { return drawn_ && evidence_.landmarks > 0; }
  Beam::PoseBelief pose_by_drawn_maps() const;
  Beam::PoseBelief pose_by_beam() const;

  NamelessSettings settings_;
  Beam beam_;
  std::optional<DrawnMaps> drawn_;
  Beam::PoseBelief start_;  // where odometry alone begins
  MotionSincePose motion_, whole_motion_;
  TrustEvidence evidence_;
  RecentDoubts recent_doubts_;
  ThinnedPath path_;
  std::vector<BelievedPose> other_answers_;  // for each pose of the path, of when it was the newest
  KeyframeLimit limit_;
  std::vector<std::int64_t> bearing_numbers_;  // of those in the graphs
  std::int64_t bearings_so_far_ = 0;
  std::optional<Stamp> last_used_;
  std::vector<NamelessSighting> sightings_;
};

}  // namespace azimuth
