#include "tests/support/spoilt_run.hpp"

#include <cmath>
#include <utility>

#include "slam/geometry/motion.hpp"

namespace azimuth::test {
namespace {

/// Odometry put together anew from motions that `change` has been at.
template <class Change>
Run with_motions(Run run, const Change& change) {
  Pose2 T = run.odometry.front().T_odom_body;
  Pose2 before = T;
  for (std::size_t i = 1; i < run.odometry.size(); ++i) {
    const Pose2 now = run.odometry[i].T_odom_body;
    T = move(T, change(control_between(before, now)));
    run.odometry[i].T_odom_body = T;
    before = now;
  }
  return run;
}

template <class Change>
Run with_bearings(Run run, const Change& change) {
  for (BearingSet& set : run.bearings)
    for (Bearing& bearing : set.bearings) change(bearing);
  return run;
}

}  // namespace

Run with_mirrored_azimuths(Run run) {
  return with_bearings(std::move(run), [](Bearing& bearing) { bearing.azimuth_rad = wrap(-bearing.azimuth_rad); });
}

Run with_swapped_wheels(Run run) {
  return with_motions(std::move(run), [](const Control& went) {
    return Control{went.distance_m, -went.first_turn_rad, -went.second_turn_rad};
  });
}

Run with_turned_camera(Run run, double by_rad) {
  return with_bearings(std::move(run),
                       [by_rad](Bearing& bearing) { bearing.azimuth_rad = wrap(bearing.azimuth_rad + by_rad); });
}

Run with_scaled_turns(Run run, double scale) {
  return with_motions(std::move(run), [scale](const Control& went) {
    return Control{went.distance_m, scale * went.first_turn_rad, scale * went.second_turn_rad};
  });
}

Run with_scaled_distances(Run run, double scale) {
  return with_motions(std::move(run), [scale](const Control& went) {
    return Control{scale * went.distance_m, went.first_turn_rad, went.second_turn_rad};
  });
}

Run with_drift(Run run, double rad_per_m) {
  return with_motions(std::move(run), [rad_per_m](const Control& went) {
    const double half_rad = 0.5 * rad_per_m * went.distance_m;
    return Control{went.distance_m, went.first_turn_rad + half_rad, went.second_turn_rad + half_rad};
  });
}

Run with_late_odometry(Run run, double by_s, double growth) {
  const Stamp first = run.odometry.front().stamp;
  for (OdometryReading& reading : run.odometry)
    reading.stamp += duration_from_seconds(by_s + growth * to_seconds(reading.stamp - first));
  return run;
}

Run with_radii(Run run) {
  int number = 0;
  return with_bearings(std::move(run),
                       [&number](Bearing& bearing) { bearing.radius_px = 80.0 + (number++ * 37) % 271; });
}

Run with_centre_off(Run run, const Eigen::Vector2d& by_px) {
  return with_bearings(with_radii(std::move(run)), [&by_px](Bearing& bearing) {
    const Eigen::Vector2d pixel =
        bearing.radius_px * Eigen::Vector2d(std::cos(bearing.azimuth_rad), std::sin(bearing.azimuth_rad)) + by_px;
    bearing.azimuth_rad = std::atan2(pixel.y(), pixel.x());
    bearing.radius_px = pixel.norm();
  });
}

}  // namespace azimuth::test
