#pragma once
// Wheel odometry as programs that know bot_core send it: pose_t, read as a cumulative pose in the plane.
//
// Thread contract: reentrant.

#include <optional>
#include <span>
#include <vector>

#include "base/bytes.hpp"
#include "slam/sample/odometry.hpp"
#include "slam/sample/odometry_steps.hpp"

namespace azimuth {

/// Stamp and pose; such messages have neither sequence nor origin. Nothing when the bytes are no sound pose_t, or its
/// orientation is none.
std::optional<OdometryReading> decode_bot_odometry(Bytes data);

/// Gives readings of one recording, which are in the order of their stamps, sequence numbers, and where wheels cannot
/// have gone from one to the next, a new origin (part_at_jumps()).
std::vector<OdometryJump> number_odometry(std::span<OdometryReading> readings);

}  // namespace azimuth
