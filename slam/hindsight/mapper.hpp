#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "slam/estimator/judgement.hpp"
#include "slam/geometry/motion.hpp"
#include "slam/hypotheses/scene.hpp"
#include "slam/localisation/image_match.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/map_snapshot.hpp"
#include "slam/smoother/rig_belief.hpp"
#include "slam/smoother/smoother.hpp"
#include "slam/smoother/thinned_path.hpp"

namespace azimuth {

/// Of a solution that has all the time there is: many times what any drive has needed.
inline constexpr int kIterationsToTheEnd = 200;

/// A landmark, by what it is called outside and in the graph.
struct HindsightLandmark {
  std::int64_t id = 0;  ///< see LandmarkEstimate
  Identity identity = kUnknownIdentity;
  Kind kind = kAnyKind;
  LandmarkId in_graph = 0;
  std::uint64_t sightings = 0;  ///< bearings that are of it, by now and before the start
  bool recalled = false;        ///< from a saved map
};

/// A bearing of the last image that is used, as the graph explains it now.
struct HeardBearing {
  std::int64_t landmark_id = 0;
  double azimuth_rad = 0.0;  ///< in the robot's frame
  double sigma_rad = 0.0;
  bool established = false;   ///< the landmark had been seen often enough to be expected
  bool of_last_image = true;  ///< else it was heard before, and is told only now
  bool agrees = false;        ///< else the robust kernel hardly listens to it
};

/// What became of the bearings of one image.
struct UpdateOutcome {
  bool used = false;  ///< it made a pose, or added to the newest one
  std::size_t created = 0, deleted = 0, thinned = 0, ambiguous = 0, recovered = 0;  ///< as in AssociationCounts
};

/// Path and map by everything heard so far. Which bearing is of which landmark is found out in one way or another; that
/// is where mappers differ.
///
/// Azimuths are in the robot's frame. What is returned by reference stands until the next update(). Thread contract:
/// thread-bound.
class Mapper {
 public:
  virtual ~Mapper() = default;

  /// Begins from a saved map, before anything else, with the robot where the map saw it last, give or take `moved`
  /// (covariance of (x, y, heading)), or nobody knows where. False: it cannot, and begins from nothing.
  virtual bool remember(const MapSnapshot& /*map*/, const std::optional<Eigen::Matrix3d>& /*moved*/) { return false; }

  /// The robot moved, before the next update().
  virtual void predict(const Motion& motion) = 0;
  /// The bearings of the instant that predict() led to.
  virtual UpdateOutcome update(const BearingSet& set) = 0;
  /// Path and map as they are now can be come back to.
  virtual void bookmark() {}
  /// What was heard since the bookmark was heard somewhere else: it is forgotten, and how the robot moved with it, so
  /// place() is to follow.
  virtual void return_to_bookmark() {}
  /// The robot is here, whatever odometry has said since the newest pose: covariance of (x, y, heading) in the map.
  /// Where nothing can be found out but by following the robot, it does nothing.
  virtual void place(const PoseGaussian& /*robot*/) {}

  /// Of the last image, by all up to it.
  virtual PoseGaussian pose() const = 0;
  /// Bearings of the last image, or of some before, that are of landmarks: each is told once.
  virtual std::span<const HeardBearing> heard() const = 0;
  /// Landmarks that bearings are of.
  virtual std::span<const HindsightLandmark> landmarks() const = 0;
  /// No landmark has had this id or a higher one.
  virtual std::int64_t next_id() const = 0;
  /// The likeliest path and map.
  virtual const Smoother& smoother() const = 0;
  /// Of the poses that its graph has, ascending: it may have forgotten some that arrived.
  virtual const std::vector<PoseNumber>& numbers() const = 0;
  /// What is known now of a pose that the graph has or had.
  virtual PoseGaussian past(PoseNumber number) const = 0;
  /// Where one is now that the graph still has, which is known at once; nothing: it has been forgotten.
  std::optional<Pose2> kept_pose(PoseNumber number) const;
  /// Nothing more will come: what smoother() and past() tell is solved until nothing changes.
  virtual void conclude() = 0;
  /// The pose of the graph that the last image's lies behind, its newest one, and how, noise included.
  virtual PoseNumber anchor() const = 0;
  virtual Motion since_anchor() const = 0;

  /// What it goes by of the rig; nothing: the rig as it is.
  virtual std::optional<RigBelief> rig() const { return std::nullopt; }

  /// What it has learnt of how much is seen of what stands there; nothing: it does not ask.
  virtual std::optional<Scene> scene() const { return std::nullopt; }

  /// Why what pose() says is not to be relied on, though nothing contradicts it; nothing: it is.
  virtual std::optional<Judgement> doubt() const { return std::nullopt; }
};

inline std::optional<Pose2> Mapper::kept_pose(PoseNumber number) const {
  const std::vector<PoseNumber>& kept = numbers();
  const auto found = std::ranges::lower_bound(kept, number);
  if (found == kept.end() || *found != number) return std::nullopt;
  return smoother().graph().pose(static_cast<PoseId>(found - kept.begin()));
}

}  // namespace azimuth
