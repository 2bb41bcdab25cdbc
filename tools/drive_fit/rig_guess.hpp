#pragma once
// What a rig may be like instead of what it says.

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "slam/estimator/rig.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/smoother/bearing_graph.hpp"

namespace azimuth {

/// A graph has two numbers for what motions are told beside their scales (ByLag). What they stand for here.
enum class MotionNumbers : std::uint8_t {
  clock,  ///< the rig's lag, and how fast it grows
  jump,   ///< the rig's lag, and by how much the camera's clock jumps
  mount,  ///< where the camera is: forwards and to the left of the point that odometry is of
};

/// From an instant on, stamps of images are later by so much than they were.
struct CameraJump {
  Stamp at{};            ///< by the camera's clock
  double after_s = 0.0;  ///< the same, since the drive's first image
  double by_s = 0.0;
  bool has_jumped(Stamp stamp) const { return by_s != 0.0 && stamp >= at; }
  Stamp without(Stamp stamp) const { return has_jumped(stamp) ? stamp - duration_from_seconds(by_s) : stamp; }
  friend bool operator==(const CameraJump&, const CameraJump&) = default;
};

struct RigGuess {
  /// Its odometry, its yaw and its position count. The path of a solution is the camera's.
  Rig rig;
  bool mirrored = false;  ///< azimuths of the drive are those of a mirror
  CameraJump jump{};      ///< none: by_s is 0
  MotionNumbers numbers = MotionNumbers::clock;
  /// Where the image's centre is, from where it was said to be: x towards azimuth 0 of the camera, y towards 90
  /// degrees.
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  bool large_turns_alone = false;  ///< tell the scale of turns: see motions_between()
};

/// Of the camera, from the point that odometry is of, forwards and to the left.
Eigen::Vector2d mount_of(const Rig& rig);

/// The numbers of a guess that are looked for, in the order of calibration::, with those of `numbers` where a lag and
/// its growth have their place. The scale of distance among them is what it is in the rig; scales are absolute, not
/// relative errors.
Calibration numbers_of(const RigGuess& guess);
/// By errors that a graph has found for `guess`.
RigGuess moved(const RigGuess& guess, const Calibration& errors);
/// d(numbers_of) / d(errors), at no error.
Eigen::Matrix<double, kCalibrations, kCalibrations> by_errors(const RigGuess& guess);

/// In the robot's frame.
double robot_azimuth(const Bearing& bearing, const RigGuess& guess);
ByCentre by_centre(const Bearing& bearing, const RigGuess& guess);

/// Whether the azimuths are worked out of pixels, so that keys about images are the ones to change.
bool sees_images(const Rig& rig);
/// The rig that says what the guess does: yaw and hand in the keys that the rig's camera has for them.
Rig rig_saying(const RigGuess& guess, const Rig& said_before);
/// "camera.azimuths_clockwise = false", "camera.yaw_offset_rad = 0.0000": which way azimuths grow and where they begin,
/// by the keys that the rig's camera has for them.
std::string direction_text(const Rig& rig);
std::string heading_text(const Rig& rig);
/// An offset of the centre in pixels of the image, (u, v), from one in the camera's azimuths.
Eigen::Vector2d in_image(const Eigen::Vector2d& centre_px, const Rig& rig);

}  // namespace azimuth
