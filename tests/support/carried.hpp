#pragma once
#include <optional>

#include "slam/geometry/pose2.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// A drive (a World or a Run) in which somebody picks the robot up and sets it down again. The drive continues with the
/// samples from `skipped` later; neither camera nor odometer records the time in between.
template <class Drive>
Drive carried(Drive drive, Stamp when, Duration skipped) {
  std::optional<Pose2> T_odom_before;
  Pose2 T_odom_last;
  for (auto& reading : drive.odometry) {
    if (reading.stamp < when) T_odom_last = reading.T_odom_body;
    if (reading.stamp < when + skipped) continue;
    if (!T_odom_before) T_odom_before = T_odom_last * inverse(reading.T_odom_body);
    reading.T_odom_body = *T_odom_before * reading.T_odom_body;
  }
  const auto cut = [&](auto& samples) {
    std::erase_if(samples, [&](const auto& sample) { return sample.stamp >= when && sample.stamp < when + skipped; });
    for (auto& sample : samples)
      if (sample.stamp >= when) sample.stamp -= skipped;
  };
  cut(drive.odometry);
  cut(drive.bearings);
  cut(drive.truth);
  for (std::size_t i = 0; i < drive.odometry.size(); ++i) drive.odometry[i].sequence = i;
  return drive;
}

}  // namespace azimuth
