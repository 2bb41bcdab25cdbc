#pragma once
// Wheel odometry as programs that know bot_core send it: pose_t, read as a cumulative pose in the plane.
//
// Thread contract: reentrant.

#include <optional>
#include <span>

#include "base/bytes.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// Stamp and pose; such messages have neither sequence nor origin. Nothing when the bytes are no sound pose_t, or its
/// orientation is none.
std::optional<OdometryReading> decode_bot_odometry(Bytes data);

/// Whether no wheel can have rolled from one reading to the other: an odometer that restarted without a word.
bool is_restart(const OdometryReading& before, const OdometryReading& now);

/// Gives readings of one recording, which are in the order of their stamps, sequence numbers, and a new origin wherever
/// is_restart() says so.
void number_bot_odometry(std::span<OdometryReading> readings);

}  // namespace azimuth
