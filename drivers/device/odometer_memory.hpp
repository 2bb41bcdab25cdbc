#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>

#include "slam/geometry/pose2.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// The last values of an odometer, and the pose of its readings at that time. A controller, a base or another process
/// continues to count while the daemon does not run. With this memory the readings of the next process continue in the
/// same frame. Everything else is requested from the robot again.
struct OdometerMemory {
  static constexpr std::size_t kMostNumbers = 16;

  /// The kind of odometer and its address. The memory of another odometer is not used.
  std::string odometer;
  std::string robot;         ///< the robot's own name; may be empty
  std::uint32_t origin = 0;  ///< origin of the readings
  Stamp at{};                ///< time of the values below
  Pose2 T_odom_body;         ///< pose at that time
  /// The counters and other numbers of this kind of odometer, in the layout of its driver.
  std::array<std::uint64_t, kMostNumbers> numbers{};
  friend bool operator==(const OdometerMemory&, const OdometerMemory&) = default;

  double real(std::size_t i) const { return std::bit_cast<double>(numbers.at(i)); }
  void put(std::size_t i, double value) { numbers.at(i) = std::bit_cast<std::uint64_t>(value); }
};

}  // namespace azimuth
