#pragma once
// Drives the smoother estimator image by image through a simulated world with named landmarks. No estimator stage is
// involved, so the measured cost of an image is the estimator's own. The rig knows the odometer's scale of distance.

#include <cstddef>
#include <memory>
#include <vector>

#include "sim/world/simulate.hpp"
#include "slam/estimator/odometry_track.hpp"
#include "slam/hindsight/hindsight_settings.hpp"
#include "slam/hindsight/smoother_estimator.hpp"
#include "tools/evaluate/trajectory.hpp"

namespace azimuth {

class HindsightDrive {
 public:
  HindsightDrive(const Scenario& scenario, const HindsightSettings& settings);

  const World& world() const { return world_; }
  bool done() const { return online_.size() == world_.bearings.size(); }
  /// Stamp of the next image; requires !done().
  Stamp next() const { return world_.bearings[online_.size()].stamp; }
  /// Processes the next image and returns the CPU time of the thread until pose and map are available [s]; requires
  /// !done().
  double hear_s();

  /// Replaces the estimator by a new one that starts from its map; false: the map is not worth saving.
  bool start_again();

  const SmootherEstimator& estimator() const { return static_cast<const SmootherEstimator&>(*estimator_); }
  const BearingGraph& graph() const { return estimator().mapper().smoother().graph(); }

  struct Errors {
    double rmse_m = 0.0;  ///< RMSE of the position after the best rigid alignment
    double anees = 0.0;   ///< relative to the first image; 3 if the stated covariances are correct
  };
  Errors online() const { return errors_of(online_); }  ///< errors of the live estimate at each image
  Errors hindsight() const;                             ///< errors of all poses as estimated now

 private:
  Errors errors_of(const std::vector<EstimateRecord>& estimates) const;

  Rig rig_;
  HindsightSettings settings_;
  World world_;
  std::unique_ptr<Estimator> estimator_;
  OdometryTrack track_;
  std::size_t readings_ = 0;
  Estimate told_;
  std::vector<EstimateRecord> online_;
};

}  // namespace azimuth
