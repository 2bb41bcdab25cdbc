#pragma once
// How the simulated robot gets along its path. A driver knows where the robot really is and steers by it, as a person
// with a joystick would; what it never sees is the estimate.

#include <cstddef>
#include <memory>
#include <optional>
#include <variant>

#include "sim/world/random.hpp"
#include "sim/world/scene.hpp"
#include "slam/geometry/motion.hpp"

namespace azimuth {

/// Stop and go: turn, drive straight, turn, take a picture (SPEC I.15, experiment 1).
struct StepDrive {
  int steps = 36;
  double step_m = 1.0;             ///< along the path, from stop to stop; the path is driven round again when it ends
  double period_s = 1.0;           ///< time from stop to stop
  double sigma_aim_m = 0.1;        ///< each stop lies beside the path by about this much, in x and in y
  double sigma_heading_rad = 0.1;  ///< and the robot faces off the direction of the path by about this much
};

/// A differential drive that never stops before the end: pure pursuit with limited speed, acceleration and turn rate.
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
  /// Where the drive begins, facing along the path.
  virtual Pose2 start() const = 0;
  /// The control for the next tick of a robot that is at `T_world_body`; nothing when the drive is over.
  virtual std::optional<Control> next(const Pose2& T_world_body) = 0;
};

/// `path` must have at least two different corners.
std::unique_ptr<Driver> make_driver(const DriveSettings& settings, const Path& path, const Random& random);

}  // namespace azimuth
