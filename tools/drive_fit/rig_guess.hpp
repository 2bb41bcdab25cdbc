#pragma once
// A hypothesis about the rig: the stated rig with some values changed.

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "slam/estimator/rig.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/smoother/bearing_graph.hpp"

namespace azimuth {

/// Meaning of the two extra motion parameters of a graph (columns of ByLag).
enum class MotionNumbers : std::uint8_t {
  clock,  ///< the rig's lag and its growth rate
  jump,   ///< the rig's lag and the size of the camera's clock jump
  mount,  ///< the camera's position, forwards and to the left of the odometry's reference point
};

/// A jump of the camera's clock: from one instant on, all image stamps are later by a constant.
struct CameraJump {
  Stamp at{};            ///< instant of the jump, by the camera's clock
  double after_s = 0.0;  ///< the same instant, since the drive's first image
  double by_s = 0.0;     ///< size of the jump
  bool has_jumped(Stamp stamp) const { return by_s != 0.0 && stamp >= at; }
  Stamp without(Stamp stamp) const { return has_jumped(stamp) ? stamp - duration_from_seconds(by_s) : stamp; }
  friend bool operator==(const CameraJump&, const CameraJump&) = default;
};

struct RigGuess {
  /// Fits use the rig's odometry and the camera's yaw and position. The path of a solution is that of the camera.
  Rig rig;
  bool mirrored = false;  ///< the azimuths of the drive have the wrong sign
  CameraJump jump{};      ///< no jump if by_s is 0
  MotionNumbers numbers = MotionNumbers::clock;
  /// Offset of the image centre from the stated one: x towards the camera's azimuth 0, y towards azimuth 90 degrees.
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  bool large_turns_alone = false;  ///< only large turns determine the scale of turns: see motions_between()
};

/// Position of the camera, forwards and to the left of the odometry's reference point.
Eigen::Vector2d mount_of(const Rig& rig);

/// The numbers of a guess that a fit can estimate, in the order of calibration::. The slots of lag and lag growth hold
/// the two numbers that guess.numbers selects. Scales are absolute values, not relative errors.
Calibration numbers_of(const RigGuess& guess);
/// The guess corrected by the errors that a graph has estimated for it.
RigGuess moved(const RigGuess& guess, const Calibration& errors);
/// d(numbers_of) / d(errors), at zero error.
Eigen::Matrix<double, kCalibrations, kCalibrations> by_errors(const RigGuess& guess);

/// Azimuth of a bearing in the robot's frame.
double robot_azimuth(const Bearing& bearing, const RigGuess& guess);
ByCentre by_centre(const Bearing& bearing, const RigGuess& guess);

/// True if azimuths are computed from pixels, so that the rig's image keys hold direction and offset.
bool sees_images(const Rig& rig);
/// The rig equivalent to the guess. Yaw and azimuth direction are in the keys that the rig's kind of camera uses.
Rig rig_saying(const RigGuess& guess, const Rig& said_before);
/// "key = value" for the direction in which azimuths grow, and for their zero direction, with the keys that the rig's
/// kind of camera uses. Example: "camera.azimuths_clockwise = false", "camera.yaw_offset_rad = 0.0000".
std::string direction_text(const Rig& rig);
std::string heading_text(const Rig& rig);
/// Converts an offset of the image centre from the axes of RigGuess::centre_px to image pixels (u, v).
Eigen::Vector2d in_image(const Eigen::Vector2d& centre_px, const Rig& rig);

}  // namespace azimuth
