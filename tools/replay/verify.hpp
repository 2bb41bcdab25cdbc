#pragma once
#include <cstddef>
#include <span>
#include <string>

#include "drivers/storage/recorded_poses.hpp"
#include "tools/replay/replay.hpp"

namespace azimuth {

/// How far a replay gave the poses that the daemon had published, to the last bit.
struct Verification {
  std::size_t recorded = 0;
  std::size_t identical = 0;
  std::string first_difference;  ///< of the first pose that is not identical, in words; empty when there is none

  bool passed() const { return recorded == identical; }
  std::string text() const;  ///< "400 of 400 recorded poses identical", and the first difference if there is one
};

/// Compares each recorded pose with the replayed step of the same stamp: position, heading, covariance and odometry
/// pose.
Verification verify(std::span<const RecordedPose> recorded, const ReplayResult& replayed);

}  // namespace azimuth
