#pragma once
#include <cstdint>
#include <memory>

#include "slam/estimator/estimator.hpp"
#include "slam/estimator/odometry_track.hpp"
#include "slam/estimator/rig.hpp"

namespace azimuth {

struct StageSettings {
  double wait_for_odometry_s = 0.5;  ///< a bearing set whose odometry is missing for longer than this is refused
};

/// Puts samples into the order of their stamps and steps the estimator: the estimator thread of the daemon and the
/// loop of a replay run this very object.
///
/// A bearing set waits until odometry has reached its stamp; the odometry pose of its instant is interpolated. Which
/// sets are used depends on the samples alone, never on when they arrived, provided that add() sees every reading
/// stamped before a set at the latest together with that set.
///
/// Thread contract: thread-bound. add() and advance() do not allocate in the steady state.
class EstimatorStage {
 public:
  EstimatorStage(std::unique_ptr<Estimator> estimator, const Rig& rig, const StageSettings& settings);
  ~EstimatorStage();

  void add(const OdometryReading& reading);
  /// Takes the bearings by swapping storage: `set` holds a recycled, cleared set afterwards.
  void add(BearingSet& set);

  /// Makes the next step if one is due and writes its estimate; false when nothing is due. Call until false.
  bool advance(Estimate& out);

  /// The pose at the newest odometry reading, without advancing: `out.predicted` is set and landmarks are left empty.
  /// False when the newest step is as new as the newest reading.
  bool look_ahead(Estimate& out) const;

  /// No further samples will come: sets still waiting are decided by the readings at hand. Call advance() until false
  /// afterwards.
  void finish();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace azimuth
