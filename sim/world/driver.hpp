#pragma once
// How the simulated robot follows its path. A driver knows the robot's true pose and steers by it, as a person with a
// joystick would. It never sees the estimate.

#include <cstddef>
#include <memory>
#include <optional>
#include <variant>

#include "sim/world/random.hpp"
#include "sim/world/scene.hpp"
#include "slam/geometry/motion.hpp"

namespace azimuth {

/// Stop and go: turn, drive straight, turn, take an image (mathematics I.15, experiment 1).
struct StepDrive {
  int steps = 36;
  double step_m = 1.0;             ///< Distance from stop to stop along the path, which is repeated at its end
  double period_s = 1.0;           ///< Time from stop to stop
  double sigma_aim_m = 0.1;        ///< Standard deviation of each stop's offset from the path, in x and in y
  double sigma_heading_rad = 0.1;  ///< Standard deviation of the heading about the direction of the path
};

/// A differential drive that does not stop before the end: pure pursuit with limited speed, acceleration and turn rate.
struct SmoothDrive {
  double speed_m_per_s = 0.5;
  double acceleration_m_per_s2 = 0.4;
  double max_turn_rate_rad_per_s = 0.9;
  double look_ahead_m = 0.6;
  double tick_s = 0.01;
};

using DriveSettings = std::variant<StepDrive, SmoothDrive>;

/// Time between two controls.
double tick_s(const DriveSettings& settings);

/// The pose at the end of `control` in the frame of its start.
Pose2 displacement(const Control& control);

/// Thread contract: thread-bound.
class Driver {
 public:
  virtual ~Driver() = default;
  /// The start pose of the drive, facing along the path.
  virtual Pose2 start() const = 0;
  /// The control for the next tick of a robot at `T_world_body`; nullopt when the drive is over.
  virtual std::optional<Control> next(const Pose2& T_world_body) = 0;
};

/// `path` must have at least two different corners.
std::unique_ptr<Driver> make_driver(const DriveSettings& settings, const Path& path, const Random& random);

}  // namespace azimuth
