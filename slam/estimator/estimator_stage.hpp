#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "slam/estimator/estimate.hpp"
#include "slam/estimator/estimator.hpp"
#include "slam/estimator/odometry_track.hpp"
#include "slam/estimator/pose_belief.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/estimator/sample_intake.hpp"
#include "slam/estimator/sample_watch.hpp"
#include "slam/geometry/motion.hpp"

namespace azimuth {

/// Whether the pose after `motion`, plus a gap in the odometry with these standard deviations, is so uncertain that a
/// search on the map would find the robot just as soon.
bool is_vague(const Motion& motion, double sigma_gap_m = 0.0, double sigma_gap_rad = 0.0);

/// The motion since a map was saved, by odometry alone, as long as odometry can be trusted. It cannot when the robot is
/// lost, was carried, or its wheels slipped.
///
/// Thread contract: thread-bound; never allocates.
class DeadReckoning {
 public:
  /// Starts from a map saved at the instant `map`, with the robot at `pose`.
  void begin(Stamp map, const PoseBelief& pose);
  void end() { start_.reset(); }
  /// The robot moved by `motion`, and the estimator believes it to be at `now`.
  void add(const Motion& motion, const PoseBelief& now, Health health);

  /// The motion since begin(). Nothing when odometry cannot be trusted any more or the motion is too uncertain to be of
  /// use.
  std::optional<Motion> motion() const;
  Stamp map() const { return map_; }  ///< The instant of the saved map; requires motion()

 private:
  bool explains(const PoseBelief& now) const;

  Stamp map_{};
  std::optional<PoseBelief> start_;
  Motion motion_;
};

struct StageSettings {
  double wait_for_odometry_s = 0.5;  ///< A bearing set whose odometry is missing for longer than this is refused
};

/// Puts samples into the order of their stamps and steps the estimator. The estimator thread of the daemon and the loop
/// of a replay both run this class.
///
/// A bearing set waits until odometry has reached its stamp. The odometry pose at its instant is interpolated, but not
/// across an outage that the odometer cannot vouch for: such a set is refused. The steps depend only on the samples
/// that were accepted and on their stamps, never on when the samples arrived: a reading that arrives after a set gave
/// up waiting for it is refused. The accepted samples, sorted by stamp, therefore give the same steps again.
///
/// When a name occurs more than once in one image, the name is dropped from these bearings (see
/// SampleIntake::doubt_repeated_names), whatever the estimator. They are counted as rejected.
///
/// Thread contract: thread-bound. add() and advance() do not allocate in the steady state.
class EstimatorStage {
 public:
  /// With `since` the estimator starts from the saved map that `since` names, and keeps the pose from there if the
  /// first reading comes from the same odometer origin.
  EstimatorStage(std::unique_ptr<Estimator> estimator, const Rig& rig, const StageSettings& settings,
                 const std::optional<OdometrySince>& since = {});

  /// Returns false when the reading is refused and counted: it is not finite, out of order, or too late.
  bool add(const OdometryReading& reading);
  /// Takes the bearings by swapping storage: afterwards `set` holds recycled, empty storage.
  void add(BearingSet& set);

  /// Makes the next step if one is due and writes its estimate. Returns false when no step is due. Call until false.
  bool advance(Estimate& out);

  /// Called in every step between prediction and update, with the set that is about to be used: for drawing expected
  /// bearings beside detected ones.
  using BeforeUpdate = std::function<void(const BearingSet& set, const Estimator& estimator)>;
  void before_update(BeforeUpdate call) { before_update_ = std::move(call); }

  /// Writes the pose at the newest odometry reading, without advancing. `out.predicted` is set and landmarks are left
  /// empty. Returns false when no reading came since the last step or the last call.
  bool look_ahead(Estimate& out);

  /// No more samples will come: sets that still wait are decided by the readings at hand. Call advance() until false
  /// afterwards.
  void finish();

  /// The judgement of the samples so far. While no landmark is mapped, the trouble it finds becomes the estimate's
  /// reason.
  const SampleWatch& samples() const { return samples_; }

  /// See Estimator::save_map(). The map is stamped with the last step.
  bool save_map(MapSnapshot& out) const;

  /// Whether the first reading continues the odometry that the constructor got as `since`. Nothing while no reading has
  /// come, or when `since` was empty.
  std::optional<bool> odometry_goes_on() const { return goes_on_; }

  /// The map just written by save_map() is being stored. Until map_is_kept() is called, the next start would use the
  /// map before it.
  void map_is_made();
  /// The map announced by map_is_made() is stored: the next start will use it.
  void map_is_kept();
  /// Whether a reading has come. Until then the estimator knows only what it knew at the start.
  bool has_odometry() const { return begun_; }
  /// Writes the odometry from the stored map up to the newest reading. Returns false when odometry does not tell where
  /// the robot is.
  bool since_map(OdometrySince& out) const { return since(reckoning_, out); }
  /// Writes the odometry from the map announced by map_is_made() up to the newest reading. Returns false like
  /// since_map().
  bool since_made_map(OdometrySince& out) const { return since(reckoning_made_, out); }

  /// To be called after finish(); see Estimator::conclude().
  void conclude() { estimator_->conclude(); }

  const Estimator& estimator() const { return *estimator_; }

 private:
  enum class Readiness { wait, ready, never };

  Readiness readiness(Stamp stamp) const;
  Duration lead() const;
  void begin(const OdometryReading& first);
  void step(const BearingSet& set, Estimate& out);
  void finish_estimate(Stamp stamp, const Pose2& T_odom_body, Estimate& out);
  bool since(const DeadReckoning& reckoning, OdometrySince& out) const;
  void give_up_first();
  void refuse_first();

  std::unique_ptr<Estimator> estimator_;
  BeforeUpdate before_update_;
  Duration wait_limit_;
  ReadingClock clock_;
  bool azimuths_clockwise_, has_names_;
  double sigma_bearing_rad_;
  OdometryRig odometry_rig_;
  OdometryTrack track_;
  SampleWatch samples_;
  std::optional<OdometrySince> since_;  // odometry since the saved map, as given at the start
  std::optional<bool> goes_on_;
  DeadReckoning reckoning_, reckoning_made_;
  PoseBelief last_belief_{};  // belief after the last step
  SampleIntake intake_;
  WaitingSets waiting_;
  std::optional<Stamp> last_step_, last_look_;
  std::uint64_t sequence_ = 0, steps_ = 0;
  bool begun_ = false, finished_ = false;
};

}  // namespace azimuth
