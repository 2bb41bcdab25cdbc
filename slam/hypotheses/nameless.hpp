#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "slam/geometry/motion.hpp"
#include "slam/hypotheses/beam.hpp"
#include "slam/hypotheses/drawn_map.hpp"
#include "slam/hypotheses/trust.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/smoother/keyframe_limit.hpp"
#include "slam/smoother/motion_since_pose.hpp"
#include "slam/smoother/thinned_path.hpp"

namespace azimuth {

struct NamelessSettings {
  BeamSettings beam;
  /// Settings of the drawn maps, which estimate the current pose when the field of view is narrow. The beam then still
  /// estimates past poses.
  DrawnMapsSettings drawn;
  /// Images nearer in time than this share most of their errors, so only one of them is used (mathematics part V).
  double thinning_s = 0.4;
  /// An image is used earlier when the robot has driven this far, since the robot then sees the landmarks from another
  /// place.
  double far_m = 0.3;
  /// The limit on the number of used images (keyframes). Beyond it, the least valuable images should be removed
  /// (mathematics VI.24); 0: no limit.
  int max_keyframes = 0;
  MotionFloors floors;
  /// Standard deviations of the rig's values as the rig states them, and those of a wrong rig (mathematics VI.33); 0:
  /// the value is exact, or never doubted.
  CalibrationPriors rig, rig_if_wrong;
  /// Relative standard deviations of the remaining scale errors of odometry.
  double sigma_scale_distance = 0.01, sigma_scale_turn = 0.01;
};

/// Path and map of a robot whose landmarks all look alike. The inputs are odometry and images; each used image makes
/// one pose. Identities of bearings are ignored.
///
/// Thread contract: thread-bound; work is distributed by `workers`. The same calls give the same bits, regardless of
/// the workers.
class Nameless {
 public:
  explicit Nameless(const NamelessSettings& settings);

  /// Starts from a saved map, at the robot's pose in the map with the additional covariance `moved` of (x, y, heading)
  /// in the map. This must be the first call.
  void remember(const MapSnapshot& map, const Eigen::Matrix3d& moved);
  /// Adds a motion of the robot before the next update().
  void predict(const Motion& motion);
  /// Sets the robot's pose from an external source and discards the odometry since the last image.
  void place(const Beam::PoseBelief& robot);
  /// Adds the bearings taken at the pose that predict() has led to. Returns true when the image was used and made a new
  /// pose.
  bool update(const BearingSet& set, Workers& workers);

  /// Whether there are more images than the limit allows; the caller then calls forget().
  bool is_full() const { return limit_.is_exceeded(beam_.best().graph()); }
  /// Removes from all members the images that are least valuable to the best member, unless landmarks need them.
  void forget(Workers& workers);

  /// Pose at the last image, given everything up to it, and its covariance of (x, y, heading) in the map, relative to
  /// the first pose. Drawn maps give this pose where they are used. Otherwise the pose is a mixture of the beam's pose
  /// and of odometry alone, since all members of the beam may be wrong.
  Beam::PoseBelief pose() const;
  /// Whether pose() can be relied on, and the reason if not.
  Trust trust() const { return azimuth::trust(evidence_, recent_doubts_); }
  const TrustEvidence& evidence() const { return evidence_; }
  /// The pose by odometry alone, without any bearing.
  Beam::PoseBelief odometry_alone() const;
  /// Current estimate of the pose of any image that was used. It is the beam's estimate, mixed with the estimate of the
  /// drawn maps when the pose was the newest one. Where drawn maps are not used, it is mixed with odometry alone
  /// instead. The covariance is as in pose().
  Beam::PoseBelief past(PoseNumber number) const;
  /// The newest pose of the graphs, from which since_anchor() leads to the last image; -1 before the first image.
  PoseNumber anchor() const { return has_begun() ? path_.newest() : -1; }
  /// The number of each pose that the graphs still have.
  const std::vector<PoseNumber>& numbers() const { return path_.numbers(); }
  /// Permanent number of a bearing in the order of arrival. A BearingId changes when the graphs remove other bearings.
  std::int64_t number_of(BearingId id) const { return bearing_numbers_[static_cast<std::size_t>(id)]; }
  /// Whether the graphs still have the bearing of this number.
  bool has(std::int64_t number) const { return std::ranges::binary_search(bearing_numbers_, number); }
  std::int64_t bearings_so_far() const { return bearings_so_far_; }

  const Motion& since_anchor() const { return motion_.motion(); }
  Motion since_anchor_with_floors() const { return motion_.with_floors(); }

  const Beam& beam() const { return beam_; }

  /// The errors of the rig's values. Odometry and azimuths are corrected by those that the drive contradicts. With
  /// drawn maps the rig is believed.
  const RigErrors<kCalibrations>& rig_errors() const { return rig_errors_; }
  /// Whether the drive contradicts the rig by more than any rig is wrong, so that something else must be.
  bool fits_no_rig() const { return fits_no_rig_; }

 private:
  void judge_rig(Workers& workers);
  void correct(const Calibration& errors, Workers& workers);
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
  Beam::PoseBelief start_;  // where odometry_alone() starts
  MotionSincePose motion_, whole_motion_;
  TrustEvidence evidence_;
  RecentDoubts recent_doubts_;
  ThinnedPath path_;
  // per pose of the path: the estimate by drawn maps, or by odometry alone, when the pose was the newest one
  std::vector<BelievedPose> other_answers_;
  KeyframeLimit limit_;
  std::vector<std::int64_t> bearing_numbers_;  // number of each bearing in the graphs
  std::int64_t bearings_so_far_ = 0;
  std::optional<Stamp> last_used_;
  RigErrors<kCalibrations> rig_errors_;
  Calibration corrected_ = Calibration::Zero();  // the errors that odometry and azimuths are corrected for
  bool fits_no_rig_ = false;
  PoseId images_since_judged_ = 0;
  PoseNumber start_number_ = 0;  // the pose at start_
  std::vector<NamelessSighting> sightings_;
};

}  // namespace azimuth
