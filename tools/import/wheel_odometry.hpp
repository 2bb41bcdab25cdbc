#pragma once
// Computes odometry from the counters of two wheels. Wrapping counters are unwrapped; restarts are bridged.
//
// Thread contract: reentrant.

#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// Distances that both wheels have rolled at one instant.
struct WheelReading {
  Stamp stamp{};
  double left_m = 0.0, right_m = 0.0;
};

/// Metres per recorded unit (radian or tick) of each wheel.
struct WheelCounts {
  double left_m = 1.0, right_m = 1.0;
};

/// Computes poses for a wheel track of `track_m`. `readings` are sorted by stamp; the first one is the origin. A
/// counter with an unambiguous range (it contains all readings, and some steps span nearly all of it) is unwrapped, and
/// `notes` says so. If both counters restart at zero, or if a wheel occasionally makes an impossible step, the pose
/// continues with another origin and with the uncertainty of the unknown motion. Fails, with time and size of a step,
/// if the counts make large steps without an unambiguous range. Errors name `file`.
FileResult<std::vector<OdometryReading>> wheel_odometry(std::vector<WheelReading> readings, const WheelCounts& counts,
                                                        double track_m, const std::string& file,
                                                        std::vector<std::string>& notes);

}  // namespace azimuth
