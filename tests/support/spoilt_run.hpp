#pragma once
// Runs in which one thing is wrong, made of good ones: what somebody recorded whose rig does not say how the robot is.

#include <Eigen/Core>

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

}  // namespace azimuth::test
