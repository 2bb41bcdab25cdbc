#pragma once
// What a rig may be like instead of what it says.

#include <Eigen/Core>

#include "slam/estimator/rig.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/smoother/bearing_graph.hpp"

namespace azimuth {

struct RigGuess {
  Rig rig;                ///< its odometry and its yaw count
  bool mirrored = false;  ///< azimuths of the drive are those of a mirror
  /// Where the image's centre is, from where it was said to be: x towards azimuth 0 of the camera, y towards 90
  /// degrees.
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  bool large_turns_alone = false;  ///< tell the scale of turns: see motions_between()
};

/// The numbers of a guess that are looked for, in the order of calibration::. The scale of distance among them is what
/// it is in the rig; scales are absolute, not relative errors.
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
/// An offset of the centre in pixels of the image, (u, v), from one in the camera's azimuths.
Eigen::Vector2d in_image(const Eigen::Vector2d& centre_px, const Rig& rig);

}  // namespace azimuth
