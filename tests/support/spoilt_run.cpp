#include "tests/support/spoilt_run.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "slam/geometry/motion.hpp"
#include "slam/geometry/random.hpp"
#include "tests/support/drive_of.hpp"

namespace azimuth::test {
namespace {

/// Rebuilds the odometry from its motions after `change` has modified them.
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

namespace {

constexpr double kTrack_m = 0.4, kCount_m = 2e-4;

double wrapped_count(double way_m) {
  const auto count = static_cast<std::int64_t>(std::llround(way_m / kCount_m));
  return static_cast<double>(static_cast<std::int16_t>(count)) * kCount_m;
}

Stamp middle_of(const Run& run) {
  return run.odometry.front().stamp + (run.odometry.back().stamp - run.odometry.front().stamp) / 2;
}

/// The true pose at `stamp`, interpolated.
Pose2 true_pose(const Run& run, Stamp stamp) {
  const auto after = std::ranges::lower_bound(run.truth, stamp, {}, &TruthPose::stamp);
  if (after == run.truth.begin()) return run.truth.front().T_world_body;
  if (after == run.truth.end()) return run.truth.back().T_world_body;
  const TruthPose& before = *(after - 1);
  return interpolate(before.T_world_body, after->T_world_body,
                     to_seconds(stamp - before.stamp) / to_seconds(after->stamp - before.stamp));
}

}  // namespace

Run with_wrapping_wheels(Run run) {
  double left_m = 0.0, right_m = 0.0, last_left_m = 0.0, last_right_m = 0.0;
  return with_motions(std::move(run), [&](const Control& went) {
    const double turn_rad = wrap(went.first_turn_rad + went.second_turn_rad);
    left_m += went.distance_m - 0.5 * kTrack_m * turn_rad;
    right_m += went.distance_m + 0.5 * kTrack_m * turn_rad;
    const double by_left_m = wrapped_count(left_m) - std::exchange(last_left_m, wrapped_count(left_m)),
                 by_right_m = wrapped_count(right_m) - std::exchange(last_right_m, wrapped_count(right_m));
    const double half_rad = 0.5 * (by_right_m - by_left_m) / kTrack_m;
    return Control{0.5 * (by_left_m + by_right_m), wrap(half_rad), wrap(half_rad)};
  });
}

Run with_two_senders(Run run) {
  const Pose2 T_other_odom{0.25, 0.12, 0.1};
  std::vector<OdometryReading> both;
  for (std::size_t i = 0; i < run.odometry.size(); ++i) {
    both.push_back(run.odometry[i]);
    if (i + 1 == run.odometry.size()) break;
    OdometryReading& other = both.emplace_back(run.odometry[i]);
    other.stamp += (run.odometry[i + 1].stamp - run.odometry[i].stamp) * 2 / 5;
    other.T_odom_body = T_other_odom * run.odometry[i].T_odom_body;
  }
  run.odometry = std::move(both);
  return run;
}

Run with_jumping_clock(Run run, double by_s) {
  const Stamp middle = middle_of(run);
  for (BearingSet& set : run.bearings)
    if (set.stamp >= middle) set.stamp += duration_from_seconds(by_s);
  return run;
}

Run with_creep(Run run, double standing_s, double rad_per_s, double m_per_s) {
  constexpr double kReading_s = 0.1, kImage_s = 0.2;
  const auto seen = std::ranges::lower_bound(run.bearings, middle_of(run), {}, &BearingSet::stamp);
  const Stamp stop = seen->stamp;
  const Duration standing = duration_from_seconds(standing_s);
  const auto went_on = std::ranges::lower_bound(run.odometry, stop, {}, &OdometryReading::stamp);
  const OdometryReading& before = *(went_on - 1);
  const Pose2 T_stop = interpolate(before.T_odom_body, went_on->T_odom_body,
                                   to_seconds(stop - before.stamp) / to_seconds(went_on->stamp - before.stamp));
  std::vector<OdometryReading> odometry(run.odometry.begin(), went_on);
  Pose2 T = T_stop;
  for (double t = 0.0; t < standing_s; t += kReading_s) {
    OdometryReading& reading = odometry.emplace_back(before);
    reading.stamp = stop + duration_from_seconds(t);
    reading.T_odom_body = T;
    T = T * Pose2{m_per_s * kReading_s, 0.0, rad_per_s * kReading_s};
  }
  for (auto each = went_on; each != run.odometry.end(); ++each) {
    OdometryReading& reading = odometry.emplace_back(*each);
    reading.stamp += standing;
    reading.T_odom_body = T * (inverse(T_stop) * each->T_odom_body);
  }
  std::vector<BearingSet> bearings(run.bearings.begin(), seen + 1);
  RandomNumbers<Xoshiro> random(Xoshiro(7));
  for (double t = kImage_s; t < standing_s; t += kImage_s) {
    BearingSet& set = bearings.emplace_back(*seen);
    set.stamp += duration_from_seconds(t);
    for (Bearing& bearing : set.bearings) bearing.azimuth_rad = wrap(bearing.azimuth_rad + random.normal(0.015));
  }
  for (auto each = seen + 1; each != run.bearings.end(); ++each) bearings.emplace_back(*each).stamp += standing;
  for (TruthPose& pose : run.truth)
    if (pose.stamp > stop) pose.stamp += standing;
  run.odometry = std::move(odometry);
  run.bearings = std::move(bearings);
  return run;
}

Run with_mounted_camera(Run run, const Eigen::Vector2d& at_m) {
  std::map<Identity, Eigen::Vector2d> places;
  for (const TrueLandmark& landmark : run.landmarks) places[landmark.identity] = {landmark.x_m, landmark.y_m};
  for (BearingSet& set : run.bearings) {
    const Pose2 T_world_body = true_pose(run, set.stamp);
    for (Bearing& bearing : set.bearings) {
      const auto place = places.find(bearing.identity);
      if (place == places.end()) continue;
      const Eigen::Vector2d p_body = inverse(T_world_body) * place->second, p_camera = p_body - at_m;
      const double by_rad = std::atan2(p_camera.y(), p_camera.x()) - std::atan2(p_body.y(), p_body.x());
      bearing.azimuth_rad = wrap(bearing.azimuth_rad + by_rad);
    }
  }
  return run;
}

Run roughened(Run run, std::uint64_t seed) {
  RandomNumbers<Xoshiro> random{Xoshiro(seed)};
  const double sigma_rad = rig_of_run(run).camera.sigma_bearing_rad;
  for (std::size_t i = 0; i < run.bearings.size(); ++i) {
    BearingSet& set = run.bearings[i];
    const double jitter_s = random.uniform(-0.004, 0.004);
    set.stamp += duration_from_seconds(jitter_s);
    for (Bearing& bearing : set.bearings) {
      // Laplace distribution; one bearing in a hundred is an outlier.
      const double tail_rad = 0.4 * sigma_rad * std::log(std::max(1e-9, random.uniform(0.0, 1.0)));
      const double hand = random.uniform(0.0, 1.0) < 0.5 ? -1.0 : 1.0;
      const bool is_of_nothing = random.uniform(0.0, 1.0) < 0.01;
      bearing.azimuth_rad = wrap(bearing.azimuth_rad + (is_of_nothing ? random.uniform(-1.0, 1.0) : hand * tail_rad));
    }
  }
  double driven_m = 0.0, slips_at_m = random.uniform(2.0, 10.0);
  return with_motions(std::move(run), [&](Control went) {
    driven_m += std::abs(went.distance_m);
    if (driven_m < slips_at_m) return went;
    if (driven_m > slips_at_m + 0.3) slips_at_m = driven_m + random.uniform(4.0, 12.0);
    // The wheels slip: odometry reports more distance than the robot drives, and a turn.
    went.distance_m *= 1.08;
    went.second_turn_rad += 0.05 * went.distance_m;
    return went;
  });
}

}  // namespace azimuth::test
