#pragma once
// How far odometry is off from motion to motion, as path and map show it.

#include <array>
#include <cstddef>

#include "tools/drive_fit/drive_graph.hpp"

namespace azimuth {

/// A variance of the rig's odometry.
enum class NoiseSort : std::uint8_t { distance, rotation, drift, lateral };
inline constexpr std::size_t kNoiseSorts = 4;

struct OdometryNoise {
  struct Told {
    double variance = 0.0;        ///< as the rig's lambda; of the slip, its sigma squared
    double sigma_relative = 1.0;  ///< of `variance`
    bool is_told() const { return sigma_relative <= kTold; }
  };
  /// More leaves a standard deviation uncertain by more than a quarter.
  static constexpr double kTold = 0.5;
  std::array<Told, kNoiseSorts> sorts;
  const Told& of(NoiseSort sort) const { return sorts[static_cast<std::size_t>(sort)]; }
};

/// The variances that make the drive likeliest, by scoring (SPEC VI.25).
OdometryNoise odometry_noise(const Drive& drive, const DriveSolution& solution, const HindsightSettings& settings);

/// The rig with what is told; the rest as it was.
OdometryRig with_noise(const OdometryRig& rig, const OdometryNoise& noise);

}  // namespace azimuth
