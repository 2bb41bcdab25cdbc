#pragma once
// A simulated world and the stage that estimates in it.

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "sim/world/simulate.hpp"
#include "slam/estimator/estimator_stage.hpp"
#include "slam/planar/ekf_estimator.hpp"

namespace azimuth {

/// A rig that knows the scenario's noise and calibration exactly.
Rig rig_of(const Scenario& scenario);

/// Any estimator in its stage. What was put in is given to the stage in the order of stamps, each set followed by the
/// steps that have become due.
class StagedDrive {
 public:
  StagedDrive(std::unique_ptr<Estimator> estimator, const Rig& rig);

  /// Called with every estimate.
  std::function<void(const Estimate&)> on_estimate = [](const Estimate&) {};

  /// Feeds the samples of `world` stamped before `end`, from where the last call stopped.
  void run(const World& world, Stamp end = Stamp::max());

  const EstimatorStage& stage() const { return stage_; }
  const Estimate& last() const { return last_; }

 private:
  EstimatorStage stage_;
  Estimate last_;
  std::size_t readings_ = 0, sets_ = 0;
};

/// The EKF.
class SimulatedDrive : public StagedDrive {
 public:
  SimulatedDrive(const Rig& rig, const EkfSettings& settings)
      : SimulatedDrive(std::make_unique<EkfEstimator>(rig, settings), rig) {}
  SimulatedDrive(std::unique_ptr<EkfEstimator> estimator, const Rig& rig)
      : SimulatedDrive{*estimator, std::move(estimator), rig} {}  // braces: in this order

  const EkfEstimator& estimator() const { return estimator_; }

 private:
  SimulatedDrive(const EkfEstimator& ekf, std::unique_ptr<Estimator> estimator, const Rig& rig)
      : StagedDrive(std::move(estimator), rig), estimator_(ekf) {}
  const EkfEstimator& estimator_;
};

/// Where the robot really was at `stamp`, interpolated.
Pose2 true_pose(const World& world, Stamp stamp);

/// Distance of the estimated position from the true one; the map's frame is the true pose of the first set.
double position_error_m(const World& world, const Estimate& estimate);

}  // namespace azimuth
