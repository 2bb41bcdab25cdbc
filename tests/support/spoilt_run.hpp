#pragma once
// Runs in which one thing is wrong, made of good ones: what somebody recorded whose rig does not say how the robot is.

#include <Eigen/Core>
#include <cstdint>

#include "drivers/storage/run.hpp"

namespace azimuth::test {

/// Bearings that grow clockwise.
Run with_mirrored_azimuths(Run run);
/// Left and right wheel exchanged: every turn is reported the other way round.
Run with_swapped_wheels(Run run);
/// The camera stands turned by so much to the right of where the rig has it.
Run with_turned_camera(Run run, double by_rad);
/// Odometry that reports so many times every turn, or every distance.
Run with_scaled_turns(Run run, double scale);
Run with_scaled_distances(Run run, double scale);
/// Odometry that turns by so much too much in each metre.
Run with_drift(Run run, double rad_per_m);
/// Odometry whose stamps are too late by so much, and by so much more each second.
Run with_late_odometry(Run run, double by_s, double growth = 0.0);
/// Bearings that say how far from the image's centre they were seen, from 80 to 350 px.
Run with_radii(Run run);
/// Likewise, worked out about a centre that is off by so much: x towards azimuth 0, y towards 90 degrees.
Run with_centre_off(Run run, const Eigen::Vector2d& by_px);

/// Wheels that are counted to 16 bits, five counts to a millimetre, and made to poses as if nothing wrapped.
Run with_wrapping_wheels(Run run);
/// A second sender on the odometer's topic, whose poses are in a frame elsewhere.
Run with_two_senders(Run run);
/// The camera's clock goes on `by_s` later from the middle of the drive on.
Run with_jumping_clock(Run run, double by_s);
/// The robot stands for `standing_s` in the middle of the drive, and in sight of what it saw there last, while its
/// odometer goes on turning and driving.
Run with_creep(Run run, double standing_s, double rad_per_s, double m_per_s);
/// The camera stands so far ahead of the point that odometry is of, and to the left. The run has truth.
Run with_mounted_camera(Run run, const Eigen::Vector2d& at_m);

/// What no estimator here assumes: stamps of bearings that jitter by milliseconds, errors of bearings with heavy tails
/// and some that are of nothing, wheels that slip now and then.
Run roughened(Run run, std::uint64_t seed);

}  // namespace azimuth::test
