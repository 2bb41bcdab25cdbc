#pragma once
// A simulated drive among named landmarks through the smoother, image by image and without a stage around it: what an
// image costs is the estimator's own. The rig knows the odometer's scale of distance.

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
  /// Of the next image; requires !done().
  Stamp next() const { return world_.bearings[online_.size()].stamp; }
  /// The next image, what it costs the thread in seconds until pose and map are told; requires !done().
  double hear_s();

  /// The estimator gives way to another one that starts from its map; false: there is none worth it.
  bool start_again();

  const SmootherEstimator& estimator() const { return static_cast<const SmootherEstimator&>(*estimator_); }
  const BearingGraph& graph() const { return estimator().mapper().smoother().graph(); }

  struct Errors {
    double rmse_m = 0.0;  ///< of the position, after the rigid motion that fits best
    double anees = 0.0;   ///< relative to the first image, 3 when what is said of the errors is true
  };
  Errors online() const { return errors_of(online_); }  ///< of what was said at each image until now
  Errors hindsight() const;                             ///< of what is known of each of them now

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
