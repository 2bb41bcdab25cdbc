#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>

#include "slam/geometry/pose2.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// What an odometer showed last, and where that was in the frame of its readings. A controller, a base or another
/// process goes on counting while nobody listens: with this the next process's readings go on in the same frame. The
/// robot is asked again for everything else.
struct OdometerMemory {
  static constexpr std::size_t kMostNumbers = 16;

  std::string odometer;      ///< which kind, and how it is reached: what others wrote is of no use
  std::string robot;         ///< what the robot calls itself; may be empty
  std::uint32_t origin = 0;  ///< of the readings
  Stamp at{};                ///< when it showed what follows
  Pose2 T_odom_body;         ///< then
  /// The counters, and what else that kind of odometer needs, as its driver has it.
  std::array<std::uint64_t, kMostNumbers> numbers{};
  friend bool operator==(const OdometerMemory&, const OdometerMemory&) = default;

  double real(std::size_t i) const { return std::bit_cast<double>(numbers.at(i)); }
  void put(std::size_t i, double value) { numbers.at(i) = std::bit_cast<std::uint64_t>(value); }
};

}  // namespace azimuth
