#pragma once
// A simulated world and the estimator stage that processes it.

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "sim/world/simulate.hpp"
#include "slam/estimator/estimator_stage.hpp"
#include "slam/planar/ekf_estimator.hpp"

namespace azimuth {

/// A rig with exactly the noise and calibration of the scenario.
Rig rig_of(const Scenario& scenario);

/// An estimator in its stage. The stage receives the samples in the order of their stamps and runs the steps that are
/// due after each bearing set.
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

/// A staged drive of the EKF.
class SimulatedDrive : public StagedDrive {
 public:
  SimulatedDrive(const Rig& rig, const EkfSettings& settings, const HealthSettings& health = {})
      : SimulatedDrive(std::make_unique<EkfEstimator>(rig, settings, MapStart{}, health), rig) {}
  SimulatedDrive(std::unique_ptr<EkfEstimator> estimator, const Rig& rig)
      : SimulatedDrive{*estimator, std::move(estimator), rig} {}  // braces guarantee the order of evaluation

  const EkfEstimator& estimator() const { return estimator_; }

 private:
  SimulatedDrive(const EkfEstimator& ekf, std::unique_ptr<Estimator> estimator, const Rig& rig)
      : StagedDrive(std::move(estimator), rig), estimator_(ekf) {}
  const EkfEstimator& estimator_;
};

/// True pose of the robot at `stamp`, interpolated.
Pose2 true_pose(const World& world, Stamp stamp);

/// Distance between estimated and true position. The map frame is the true pose of the first set.
double position_error_m(const World& world, const Estimate& estimate);

}  // namespace azimuth
