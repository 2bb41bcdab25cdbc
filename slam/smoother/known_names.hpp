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

/// How a run of named landmarks becomes a graph.
struct KnownNamesSettings {
  SmootherSettings smoother;
  double sigma_bearing_rad = 0.0262;  ///< of bearings that say none of their own
  /// Bearings of one landmark within this time share most of their error: one of them is used (SPEC part V).
  double thinning_s = 0.5;
  /// Bearings of one landmark from one place share most of their error, however much time lies between: so many are
  /// used.
  int most_from_one_place = 3;
  /// A landmark whose bearings have not fitted so many times in a row, in images whose others did, is looked for anew;
  /// 0: never.
  int replant_after = 5;
  /// Of more poses those that are worth least should be forgotten (SPEC VI.24), unless landmarks need them; 0: none.
  int max_keyframes = 0;
  MotionFloors floors;
  RigDoubts doubts;
};

/// A smoother that is told which landmark each bearing is of: one pose for each image that tells something new.
///
/// Thread contract: thread-bound. Same calls, same bits.
class KnownNames {
 public:
  explicit KnownNames(const KnownNamesSettings& settings);

  /// Begins from a saved map, before anything else: see remember(). Its landmarks have the numbers from 0 on, in the
  /// map's order.
  void remember(const MapSnapshot& map, const std::optional<Eigen::Matrix3d>& moved);

  /// The robot moved, before the next update().
  void predict(const Motion& motion);
  /// The bearings of the instant that predict() led to; those without a name are passed over. True: they made a new
  /// pose, or added to the newest one, and everything was solved anew.
  bool update(const BearingSet& set);
  /// The robot is at the last image's instant where something else says it is, with that covariance of (x, y, heading)
  /// in the map: what odometry says of the way there since the newest pose is void.
  void place(const Pose2& T_map_body, const Eigen::Matrix3d& covariance);

  /// Whether there are more poses than there may be: forget() is to follow.
  bool is_full() const { return limit_.is_exceeded(smoother_.graph()); }
  /// Those worth least, ascending; fewer than would be necessary, or none, when landmarks need them.
  std::vector<PoseId> least_worth() const { return limit_.least_worth(smoother_.graph(), path_.numbers()); }
  /// Everything is solved anew, of what is left. All that have heard the same, and are to be compared, must forget the
  /// same.
  void forget(std::span<const PoseId> poses);

  /// What it takes from the rig now, and what its measurements make of that.
  const RigBelief& rig() const { return rig_; }
  RigBelief judged_rig() const {
    return judged(smoother_, rig_, rig_belief(settings_.smoother.calibration), settings_.doubts);
  }
  /// Goes by that from now on. All that have heard the same, and are to be compared, must believe the same.
  void believe(const RigBelief& rig);

  /// Of the last image, by all up to it. Covariance of (x, y, heading), in the map: relative to the first pose.
  Pose2 pose() const;
  Eigen::Matrix3d covariance() const;
  /// The pose that the last image's lies behind, and how: with that, an image's pose can be told anew when the graph's
  /// poses have moved.
  PoseNumber anchor() const { return path_.newest(); }
  const Motion& since_anchor() const { return motion_.motion(); }
  Motion since_anchor_with_floors() const;

  /// Of the poses that the graph has.
  const std::vector<PoseNumber>& numbers() const { return path_.numbers(); }
  /// Nothing more will come: solved until nothing changes, or so many iterations were made.
  void conclude(int max_iterations) { outcome_ = smoother_.optimise(max_iterations); }
  /// Becomes another that has heard the same, but goes on listening to bad bearings as itself.
  void adopt(const KnownNames& other);
  /// What is known by now of any pose there was, whether the graph still has it or not.
  ThinnedPath::Told past(PoseNumber number) const { return path_.tell(number, smoother_); }

  const Smoother& smoother() const { return smoother_; }
  const Smoother::Outcome& last_outcome() const { return outcome_; }

  /// A bearing farther off than this says nothing of its landmark: the name is wrong, or the pose is.
  bool agrees(BearingId bearing) const { return smoother_.graph().chi2_of(bearing) < kAgreesChi2; }
  /// Of each landmark; of one that was planted anew, twice, and only the last one has bearings.
  const std::vector<Identity>& names() const { return names_; }
  /// Bearings that were of it, those that are forgotten included.
  std::size_t sightings(LandmarkId id) const {
    return forgotten_bearings(id) + smoother_.graph().bearings_of(id).size();
  }
  /// The one that bearings of that name are of now.
  bool is_current(LandmarkId id) const { return replaced_[static_cast<std::size_t>(id)] == 0; }

  /// Of the last image.
  struct LastImage {
    BearingId first = 0;                          ///< this bearing and those after it are what is used of it
    int thinned = 0, planted = 0, replanted = 0;  ///< bearings, landmarks
  };
  const LastImage& last_image() const { return last_image_; }

 private:
  static constexpr double kAgreesChi2 = 9.0;
  struct Known {
    LandmarkId landmark = kOfNothing;
    std::optional<Stamp> last_used;
    PoseNumber last_from = -1;
    int from_there = 0;  // bearings
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
  LandmarkId plant(BearingId first, Identity name);
  void replant_contradicted();
  bool is_told(LandmarkId landmark) const;
  void weigh_priors();
  bool replant(Identity name, Known& known);

  KnownNamesSettings settings_;
  Smoother smoother_;
  Smoother::Outcome outcome_;
  MotionSincePose motion_;
  RigBelief rig_;
  ThinnedPath path_;
  KeyframeLimit limit_;
  std::vector<std::uint32_t> forgotten_bearings_;  // of each landmark
  std::map<Identity, Known> known_;
  std::vector<Identity> names_;
  std::vector<char> replaced_;  // of each name, whether another landmark has it now
  LastImage last_image_;
};

}  // namespace azimuth
