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

/// Maximum number of iterations of the final optimisation; no drive needs nearly as many.
inline constexpr int kIterationsToTheEnd = 200;

/// The judgement of a drive that contradicts the rig by more than any rig is wrong.
inline constexpr Judgement kFitsNoRig{Health::degraded, "bearings and odometry fit no rig like this one"};

/// A landmark with its published id and its number in the graph.
struct HindsightLandmark {
  std::int64_t id = 0;  ///< see LandmarkEstimate
  Identity identity = kUnknownIdentity;
  Kind kind = kAnyKind;
  LandmarkId in_graph = 0;
  std::uint64_t sightings = 0;  ///< number of bearings, those before the start included
  bool recalled = false;        ///< from a saved map
};

/// A used bearing, and how the current graph explains it.
struct UsedBearing {
  std::int64_t landmark_id = 0;
  double azimuth_rad = 0.0;  ///< in the robot's frame
  double sigma_rad = 0.0;
  bool established = false;   ///< the landmark had enough bearings to be expected
  bool of_last_image = true;  ///< otherwise the bearing is of an earlier image and reported late
  bool agrees = false;        ///< otherwise the robust kernel gives it little weight
};

/// What update() did with the bearings of one image.
struct UpdateOutcome {
  bool used = false;  ///< the image made a pose or added bearings to the newest pose
  std::size_t created = 0, deleted = 0, thinned = 0, ambiguous = 0, recovered = 0;  ///< as in AssociationCounts
};

/// Path and map from all measurements so far. Mappers differ in how they decide the data association.
///
/// Azimuths are in the robot's frame. References that are returned stay valid until the next update(). Thread contract:
/// thread-bound.
class Mapper {
 public:
  virtual ~Mapper() = default;

  /// Starts from a saved map; this must be the first call. With `moved`, the robot is at its pose in the map, with that
  /// additional covariance of (x, y, heading); without, its pose is unknown. Returns false when the mapper cannot do
  /// so; it then starts from an empty map.
  virtual bool remember(const MapSnapshot& /*map*/, const std::optional<Eigen::Matrix3d>& /*moved*/) { return false; }

  /// Adds a motion of the robot before the next update().
  virtual void predict(const Motion& motion) = 0;
  /// Adds the bearings taken at the pose that predict() has led to.
  virtual UpdateOutcome update(const BearingSet& set) = 0;
  /// Stores the current path and map for return_to_bookmark().
  virtual void bookmark() {}
  /// Restores path and map as of the bookmark, for a robot that was somewhere else since then. Bearings and motions
  /// since the bookmark are discarded, so the caller must call place() afterwards.
  virtual void return_to_bookmark() {}
  /// Sets the robot's pose, with its covariance of (x, y, heading) in the map, and discards the odometry since the
  /// newest pose. The default implementation ignores the call.
  virtual void place(const PoseGaussian& /*robot*/) {}

  /// Pose at the last image, given everything up to it.
  virtual PoseGaussian pose() const = 0;
  /// Associated bearings of the last image, or of earlier ones. Each bearing is reported once.
  virtual std::span<const UsedBearing> heard() const = 0;
  /// Landmarks that have bearings.
  virtual std::span<const HindsightLandmark> landmarks() const = 0;
  /// An id above those of all landmarks so far.
  virtual std::int64_t next_id() const = 0;
  /// The most likely path and map.
  virtual const Smoother& smoother() const = 0;
  /// Numbers of the poses that the graph still has, ascending.
  virtual const std::vector<PoseNumber>& numbers() const = 0;
  /// Current estimate of a pose that the graph has or had.
  virtual PoseGaussian past(PoseNumber number) const = 0;
  /// Current position of a pose that the graph still has, without computing its covariance; empty when the graph has
  /// removed it.
  std::optional<Pose2> kept_pose(PoseNumber number) const;
  /// Ends the drive: optimises what smoother() and past() return until convergence.
  virtual void conclude() = 0;
  /// The newest pose of the graph, and the motion from it to the last image, noise included.
  virtual PoseNumber anchor() const = 0;
  virtual Motion since_anchor() const = 0;

  /// The rig belief that the mapper uses; empty: the rig unchanged.
  virtual std::optional<RigBelief> rig() const { return std::nullopt; }
  /// Errors of the rig's values as estimated, and their standard deviations.
  virtual Calibration calibration() const { return smoother().graph().calibration(); }
  virtual Calibration calibration_sigma() const { return smoother().calibration_covariance().diagonal().cwiseSqrt(); }

  /// The detection model that the mapper has learned; empty: it learns none.
  virtual std::optional<Scene> scene() const { return std::nullopt; }

  /// A reason why pose() is not to be relied on although no measurement contradicts it; empty: none.
  virtual std::optional<Judgement> doubt() const { return std::nullopt; }
};

inline std::optional<Pose2> Mapper::kept_pose(PoseNumber number) const {
  const std::vector<PoseNumber>& kept = numbers();
  const auto found = std::ranges::lower_bound(kept, number);
  if (found == kept.end() || *found != number) return std::nullopt;
  return smoother().graph().pose(static_cast<PoseId>(found - kept.begin()));
}

}  // namespace azimuth
