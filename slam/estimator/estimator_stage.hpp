#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "slam/estimator/dead_reckoning.hpp"
#include "slam/estimator/estimator.hpp"
#include "slam/estimator/odometry_track.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/estimator/sample_intake.hpp"
#include "slam/estimator/sample_watch.hpp"

namespace azimuth {

struct StageSettings {
  double wait_for_odometry_s = 0.5;  ///< a bearing set whose odometry is missing for longer than this is refused
};

/// Puts samples into the order of their stamps and steps the estimator: the estimator thread of the daemon and the
/// loop of a replay run this very object.
///
/// A bearing set waits until odometry has reached its stamp; the odometry pose of its instant is interpolated, but not
/// across an outage that the odometer says it cannot vouch for: such a set is refused. The
/// steps depend on the samples that were taken and their stamps alone, never on when they arrived: a reading that comes
/// after a set which waited for it has been given up is refused. What was taken, sorted by stamp, gives the same steps
/// again.
///
/// A name that occurs more than once in one image is believed of none of its bearings, whichever estimator there is;
/// they are counted among those rejected.
///
/// Thread contract: thread-bound. add() and advance() do not allocate in the steady state.
class EstimatorStage {
 public:
  /// With `since` the estimator starts from the map that it names, and goes on from there when the first reading is of
  /// the same origin.
  EstimatorStage(std::unique_ptr<Estimator> estimator, const Rig& rig, const StageSettings& settings,
                 const std::optional<OdometrySince>& since = {});

  /// False: refused and counted, because it is not finite, not in order, or too late.
  bool add(const OdometryReading& reading);
  /// Takes the bearings by swapping storage: `set` holds recycled, empty storage afterwards.
  void add(BearingSet& set);

  /// Makes the next step if one is due and writes its estimate; false when nothing is due. Call until false.
  bool advance(Estimate& out);

  /// Called on every step between prediction and update, with what is going to be used: for whoever draws what was
  /// expected beside what was seen.
  using BeforeUpdate = std::function<void(const BearingSet& set, const Estimator& estimator)>;
  void before_update(BeforeUpdate call) { before_update_ = std::move(call); }

  /// The pose at the newest odometry reading, without advancing: `out.predicted` is set and landmarks are left empty.
  /// False when there is no reading since the last step or the last call.
  bool look_ahead(Estimate& out);

  /// No further samples will come: sets that still wait are decided by the readings at hand. Call advance() until
  /// false afterwards.
  void finish();

  /// What keeps the samples from being of use, so far. While no landmark is mapped, it is the reason given for that.
  const SampleWatch& samples() const { return samples_; }

  /// See Estimator::save_map(); stamped with the last step.
  bool save_map(MapSnapshot& out) const;

  /// Whether the first reading goes on from `since` of the start; nothing: none has come, or there was none to go on
  /// from.
  std::optional<bool> odometry_goes_on() const { return goes_on_; }

  /// The map just written by save_map() may be what the next start begins from; until map_is_kept() the one before is.
  void map_is_made();
  /// The map made last is the one that the next start will begin from.
  void map_is_kept();
  /// Whether a reading has come: until then what was known at the start is all that is.
  bool has_odometry() const { return begun_; }
  /// The odometry since the map that is kept up to the newest reading. False: it does not tell where the robot is.
  bool since_map(OdometrySince& out) const { return since(reckoning_, out); }
  /// Likewise since the one that was made after it.
  bool since_made_map(OdometrySince& out) const { return since(reckoning_made_, out); }

  /// After finish(): see Estimator::conclude().
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
  std::optional<OdometrySince> since_;  // of the start
  std::optional<bool> goes_on_;
  DeadReckoning reckoning_, reckoning_made_;
  PoseBelief last_belief_{};  // of the last step
  SampleIntake intake_;
  WaitingSets waiting_;
  std::optional<Stamp> last_step_, last_look_;
  std::uint64_t sequence_ = 0, steps_ = 0;
  bool begun_ = false, finished_ = false;
};

}  // namespace azimuth
