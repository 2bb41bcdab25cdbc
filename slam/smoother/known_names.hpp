#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "slam/geometry/motion.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/map_snapshot.hpp"
#include "slam/smoother/keyframe_limit.hpp"
#include "slam/smoother/motion_since_pose.hpp"
#include "slam/smoother/rig_belief.hpp"
#include "slam/smoother/smoother.hpp"
#include "slam/smoother/thinned_path.hpp"

namespace azimuth {

/// Settings of KnownNames.
struct KnownNamesSettings {
  SmootherSettings smoother;
  double sigma_bearing_rad = 0.0262;  ///< for bearings without a standard deviation
  /// Bearings of one landmark within this time share most of their error, so only one of them is used (mathematics part
  /// V).
  double thinning_s = 0.5;
  /// At most so many bearings of one landmark are used while the robot stands at one place, since they share most of
  /// their error however much time passes.
  int most_from_one_place = 3;
  /// Consecutive misfits after which a landmark is initialised anew; 0: never.
  int reinitialise_after = 5;
  /// The limit on the number of poses (keyframes); beyond it, the least valuable poses should be removed (mathematics
  /// VI.24), unless landmarks need them; 0: no limit.
  int max_keyframes = 0;
  MotionFloors floors;
  RigDoubts doubts;
};

/// A smoother for landmarks with known identities. It adds one pose for each image that brings new information.
///
/// Thread contract: thread-bound. The same calls give the same bits.
class KnownNames {
 public:
  explicit KnownNames(const KnownNamesSettings& settings);

  /// Starts from a saved map: see azimuth::remember(). This must be the first call. The map's landmarks get the numbers
  /// from 0 on, in the map's order.
  void remember(const MapSnapshot& map, const std::optional<Eigen::Matrix3d>& moved);

  /// Adds a motion of the robot before the next update().
  void predict(const Motion& motion);
  /// Adds the bearings taken at the pose that predict() has led to. Bearings without an identity are ignored. Returns
  /// true when bearings were used, on a new pose or on the newest one, and the graph was optimised.
  bool update(const BearingSet& set);
  /// Sets the robot's pose at the last image from an external source, with its covariance of (x, y, heading) in the
  /// map. The odometry since the newest pose is discarded.
  void place(const Pose2& T_map_body, const Eigen::Matrix3d& covariance);

  /// Whether the graph has more poses than its limit allows; the caller then calls forget().
  bool is_full() const { return limit_.is_exceeded(smoother_.graph()); }
  /// The least valuable poses, ascending. There are fewer than necessary, or none, when landmarks need them.
  std::vector<PoseId> least_worth() const { return limit_.least_worth(smoother_.graph(), path_.numbers()); }
  /// Removes these poses and optimises the rest. All instances that are to be compared must remove the same poses.
  void forget(std::span<const PoseId> poses);

  /// The current rig belief, and the rig belief that the measurements suggest.
  const RigBelief& rig() const { return rig_; }
  RigBelief judged_rig() const {
    return judged(smoother_, rig_, rig_belief(settings_.smoother.calibration), settings_.doubts);
  }
  /// Adopts this rig belief and optimises. All instances that are to be compared must adopt the same belief.
  void believe(const RigBelief& rig);

  /// Pose at the last image, given everything up to that image, and its covariance of (x, y, heading) in the map,
  /// relative to the first pose.
  Pose2 pose() const;
  Eigen::Matrix3d covariance() const;
  /// The newest pose of the graph, and the motion from it to the last image. With both, the pose of an image can be
  /// recomputed after the graph's poses have moved.
  PoseNumber anchor() const { return path_.newest(); }
  const Motion& since_anchor() const { return motion_.motion(); }
  Motion since_anchor_with_floors() const;

  /// The number of each pose that the graph still has.
  const std::vector<PoseNumber>& numbers() const { return path_.numbers(); }
  /// Optimises at the end of a drive, until convergence or for at most `max_iterations`.
  void conclude(int max_iterations) { outcome_ = smoother_.optimise(max_iterations); }
  /// Copies another instance that had the same measurements, but keeps its own settings, robust kernel included.
  void adopt(const KnownNames& other);
  /// Current estimate of any pose there ever was, even if the graph has removed it.
  ThinnedPath::Told past(PoseNumber number) const { return path_.tell(number, smoother_); }

  const Smoother& smoother() const { return smoother_; }
  const Smoother::Outcome& last_outcome() const { return outcome_; }

  /// Whether the bearing fits its landmark. If it does not, either its identity or the pose is wrong.
  bool agrees(BearingId bearing) const { return smoother_.graph().chi2_of(bearing) < kAgreesChi2; }
  /// Identity of each landmark. The identity of a landmark that was initialised anew appears twice; only the last entry
  /// has bearings.
  const std::vector<Identity>& names() const { return names_; }
  /// Number of bearings of the landmark so far, removed ones included.
  std::size_t sightings(LandmarkId id) const {
    return forgotten_bearings(id) + smoother_.graph().bearings_of(id).size();
  }
  /// Whether new bearings of the landmark's identity are assigned to this landmark.
  bool is_current(LandmarkId id) const { return replaced_[static_cast<std::size_t>(id)] == 0; }

  /// What the last image contributed.
  struct LastImage {
    BearingId first = 0;  ///< the image's used bearings are this one and all after it
    /// Numbers of bearings thinned out, of landmarks initialised, and of landmarks initialised anew.
    int thinned = 0, initialised = 0, reinitialised = 0;
  };
  const LastImage& last_image() const { return last_image_; }

 private:
  static constexpr double kAgreesChi2 = 9.0;
  struct Known {
    LandmarkId landmark = kOfNothing;
    std::optional<Stamp> last_used;
    PoseNumber last_from = -1;
    int from_there = 0;  // number of bearings used from that pose
    int refused_in_row = 0;
  };
  void add_pose(const Motion& motion);
  std::size_t forgotten_bearings(LandmarkId id) const {
    const auto at = static_cast<std::size_t>(id);
    return at < forgotten_bearings_.size() ? forgotten_bearings_[at] : 0;
  }
  bool is_due(const Known& known, Stamp stamp) const;
  bool stands_at(PoseNumber pose) const { return anchor() == pose && !since_anchor().moved(); }
  void use(const Bearing& bearing, Known& known, Stamp stamp);
  LandmarkId initialise(BearingId first, Identity name);
  void reinitialise_contradicted();
  bool is_told(LandmarkId landmark) const;
  void weigh_priors();
  bool reinitialise(Identity name, Known& known);

  KnownNamesSettings settings_;
  Smoother smoother_;
  Smoother::Outcome outcome_;
  MotionSincePose motion_;
  RigBelief rig_;
  ThinnedPath path_;
  KeyframeLimit limit_;
  std::vector<std::uint32_t> forgotten_bearings_;  // per landmark
  std::map<Identity, Known> known_;
  std::vector<Identity> names_;
  std::vector<char> replaced_;  // per landmark, whether another landmark has its identity now
  LastImage last_image_;
};

}  // namespace azimuth
