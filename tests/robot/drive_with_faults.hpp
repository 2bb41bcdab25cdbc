#pragma once
// A long drive round the lab with a fault every ten seconds, a camera and an estimator.

#include <string>
#include <vector>

#include "sim/azimuth_sim/rover.hpp"
#include "slam/estimator/estimator_stage.hpp"
#include "slam/planar/ekf_estimator.hpp"
#include "tests/robot/driven_robot.hpp"

namespace azimuth::test {

/// A temporary fault.
struct PassingFault {
  std::string begin, end;  ///< fault texts; empty `end`: the fault ends by itself after `lasts`
  Duration lasts{};
  bool loses_link = false;  ///< loses the link or the session
};

struct DriveSetup {
  std::uint64_t seed = 1;
  /// The faults repeat in an order drawn from the seed.
  std::vector<PassingFault> faults;
  /// The controller stops the wheels after this time without a command; 0: never, so the robot drives on unobserved
  /// while the link is down.
  Duration watchdog{};
};

/// The end of a fault, and the time at which odometry returns.
struct Struck {
  std::string fault;
  bool loses_link = false;
  Stamp ended{}, back{};
};

/// Result of the estimator.
struct DriveResult {
  std::vector<Struck> struck;
  std::size_t estimates = 0, not_tracking = 0, lost = 0;
  double mean_error_m = 0.0, max_error_m = 0.0, final_error_m = 0.0;
  double max_settled_error_m = 0.0;  ///< while odometry has been back for more than three seconds
};

class DriveWithFaults {
 public:
  explicit DriveWithFaults(const DriveSetup& settings);

  DriveResult run(Duration duration);
  DrivenRobot& robot() { return robot_; }

 private:
  void run_until(Stamp end);
  void strike(const PassingFault& fault);
  void see();
  void note(const Sighting& sighting);
  void take_estimates();
  void judge(const Estimate& estimate);
  bool settled(Stamp stamp) const;

  Scenario scenario_;
  std::vector<PassingFault> faults_;
  sim::Rover rover_;
  DrivenRobot robot_;
  EstimatorStage stage_;
  Random order_, bearing_random_;
  Stamp next_set_;
  std::uint64_t sets_ = 0;
  std::vector<Pose2> truth_;  // at each bearing set
  Pose2 T_world_map_;
  Estimate estimate_;
  DriveResult result_;
};

}  // namespace azimuth::test
