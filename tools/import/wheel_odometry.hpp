#pragma once
// Odometry from what two wheels have counted: counters that wrap are unwrapped, those that begin anew are bridged.
//
// Thread contract: reentrant.

#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// How far both wheels have rolled, at one instant.
struct WheelReading {
  Stamp stamp{};
  double left_m = 0.0, right_m = 0.0;
};

/// What one count is of what was written: metres a radian, or a tick.
struct WheelCounts {
  double left_m = 1.0, right_m = 1.0;
};

/// Poses of wheels `track_m` apart, from the first of `readings` on, which are in the order of their stamps. A counter
/// whose range is plain (all its readings lie within it, and some steps are nearly all of it) is unwrapped, which
/// `notes` say. Where both begin at zero again, or a wheel makes a step now and then that no wheel makes, the pose goes
/// on from another origin, with what is unknown of the way meanwhile. Errors, of `file`: steps through most of a range
/// that is not plain, with time and size.
FileResult<std::vector<OdometryReading>> wheel_odometry(std::vector<WheelReading> readings, const WheelCounts& counts,
                                                        double track_m, const std::string& file,
                                                        std::vector<std::string>& notes);

}  // namespace azimuth
