#pragma once
#include <cstddef>
#include <span>
#include <string>

#include "drivers/storage/recorded_outputs.hpp"
#include "tools/replay/replay.hpp"

namespace azimuth {

/// Bit-exact comparison of replayed poses with the poses that the daemon published.
struct Verification {
  std::size_t recorded = 0;
  std::size_t identical = 0;
  std::string first_difference;  ///< description of the first pose that differs; empty if there is none

  bool passed() const { return recorded == identical; }
  std::string text() const;  ///< for example "400 of 400 recorded poses identical", with the first difference, if any
};

/// Compares each recorded pose with the replayed step of the same stamp: position, heading, covariance and odometry
/// pose.
Verification verify(std::span<const RecordedPose> recorded, const ReplayResult& replayed);

}  // namespace azimuth
