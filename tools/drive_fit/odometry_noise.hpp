#pragma once
// How far odometry is off from motion to motion, as path and map show it.

#include <array>
#include <cmath>
#include <cstddef>

#include "tools/drive_fit/drive_graph.hpp"

namespace azimuth {

/// A variance of the rig's odometry.
enum class NoiseSort : std::uint8_t { distance, rotation, drift, lateral };
inline constexpr std::size_t kNoiseSorts = 4;

struct OdometryNoise {
  struct Told {
    double variance = 0.0;        ///< likeliest, as the rig's lambda; of the slip, its sigma squared
    double sigma_relative = 1.0;  ///< of `variance`
    /// What may be relied on: the upper end of what is likely, and no less than a ninth of what the rig says, two
    /// standard deviations of what is believed beforehand. One drive shows one floor, and a fit takes what is steered
    /// against for less noise than there is: a variance that is too small is paid for by every later drive.
    double safe_variance = 0.0;
    bool is_held() const { return safe_variance > variance * std::exp(sigma_relative); }  ///< by the rig's
    bool is_told() const { return sigma_relative <= kTold; }
  };
  /// More leaves a standard deviation uncertain by more than a quarter.
  static constexpr double kTold = 0.5;
  std::array<Told, kNoiseSorts> sorts;
  const Told& of(NoiseSort sort) const { return sorts[static_cast<std::size_t>(sort)]; }
};

/// The variances that make the drive likeliest, by scoring (SPEC VI.25).
OdometryNoise odometry_noise(const Drive& drive, const DriveSolution& solution, const HindsightSettings& settings);

/// The rig with what is told, as far as it may be relied on; the rest as it was.
OdometryRig with_noise(const OdometryRig& rig, const OdometryNoise& noise);
OdometryRig with_noise_of(const OdometryRig& rig, const OdometryRig& noise);

}  // namespace azimuth
