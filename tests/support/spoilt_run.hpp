#pragma once
// Runs with exactly one error, derived from correct runs: the rig does not describe the robot that recorded them.

#include <Eigen/Core>
#include <cstdint>

#include "drivers/storage/run.hpp"

namespace azimuth::test {

/// Azimuths grow clockwise.
Run with_mirrored_azimuths(Run run);
/// The wheels are exchanged: odometry reports every turn with the wrong sign.
Run with_swapped_wheels(Run run);
/// The camera is turned by `by_rad` to the right of its direction in the rig.
Run with_turned_camera(Run run, double by_rad);
/// Odometry reports `scale` times every turn, or every distance.
Run with_scaled_turns(Run run, double scale);
Run with_scaled_distances(Run run, double scale);
/// Odometry reports an additional turn of `rad_per_m` in each metre.
Run with_drift(Run run, double rad_per_m);
/// The stamps of odometry are too late by `by_s`, and by `growth` more each second.
Run with_late_odometry(Run run, double by_s, double growth = 0.0);
/// Bearings include the distance from the image centre, from 80 to 350 px.
Run with_radii(Run run);
/// Bearings with radii, computed with a wrong image centre. `by_px` is the error: x towards azimuth 0, y towards 90
/// degrees.
Run with_centre_off(Run run, const Eigen::Vector2d& by_px);

/// Wheel counters of 16 bits, 5 counts per millimetre. The conversion to poses ignores their overflow.
Run with_wrapping_wheels(Run run);
/// A second sender publishes poses in another frame on the odometer's topic.
Run with_two_senders(Run run);
/// The camera's clock jumps ahead by `by_s` in the middle of the drive.
Run with_jumping_clock(Run run, double by_s);
/// The robot stands for `standing_s` in the middle of the drive and keeps seeing the same landmarks, while its odometer
/// continues to report motion.
Run with_creep(Run run, double standing_s, double rad_per_s, double m_per_s);
/// The camera is mounted at `at_m` (ahead, left) of the odometry's reference point. The run must have truth.
Run with_mounted_camera(Run run, const Eigen::Vector2d& at_m);

/// A run that violates the estimators' assumptions: stamps of bearings jitter by milliseconds, bearing errors have
/// heavy tails and outliers, and the wheels slip now and then.
Run roughened(Run run, std::uint64_t seed);

}  // namespace azimuth::test
