#pragma once
// Wheel odometry in the form of bot_core programs: pose_t, read as a cumulative pose in the plane.
//
// Thread contract: reentrant.

#include <optional>
#include <span>
#include <vector>

#include "base/bytes.hpp"
#include "slam/sample/odometry.hpp"
#include "slam/sample/odometry_steps.hpp"

namespace azimuth {

/// Decodes stamp and pose; pose_t has neither sequence nor origin. None when the bytes are not a valid pose_t, or its
/// orientation is invalid.
std::optional<OdometryReading> decode_bot_odometry(Bytes data);

/// Assigns sequence numbers to the readings of one recording, which are in the order of their stamps. Where wheels
/// cannot have moved from one reading to the next, a new origin starts (part_at_jumps()).
std::vector<OdometryJump> number_odometry(std::span<OdometryReading> readings);

}  // namespace azimuth
