#pragma once
// Estimates the noise of odometry from a fitted drive.

#include <array>
#include <cmath>
#include <cstddef>

#include "tools/drive_fit/drive_graph.hpp"

namespace azimuth {

/// The variances of the rig's odometry.
enum class NoiseSort : std::uint8_t { distance, rotation, drift, lateral };
inline constexpr std::size_t kNoiseSorts = 4;

struct OdometryNoise {
  struct Told {
    double variance = 0.0;        ///< likeliest value of the rig's lambda; for lateral slip, of its sigma squared
    double sigma_relative = 1.0;  ///< standard deviation of ln(variance)
    /// Value for use: one standard deviation above `variance`, and at least a ninth of the rig's value (two standard
    /// deviations of the prior). A drive covers only one kind of floor, and steering corrections hide part of the
    /// noise. A variance that is too small harms every later drive.
    double safe_variance = 0.0;
    /// True if the lower limit that follows from the rig's value determines safe_variance.
    bool is_held() const { return safe_variance > variance * std::exp(sigma_relative); }
    bool is_told() const { return sigma_relative <= kTold; }
  };
  /// Largest sigma_relative of a told variance: its square root is then known to a quarter.
  static constexpr double kTold = 0.5;
  std::array<Told, kNoiseSorts> sorts;
  const Told& of(NoiseSort sort) const { return sorts[static_cast<std::size_t>(sort)]; }
};

/// The maximum a posteriori variances by Fisher scoring (mathematics VI.25).
OdometryNoise odometry_noise(const Drive& drive, const DriveSolution& solution, const HindsightSettings& settings);

/// The rig with safe_variance for each told variance; the others keep the rig's values.
OdometryRig with_noise(const OdometryRig& rig, const OdometryNoise& noise);
OdometryRig with_noise_of(const OdometryRig& rig, const OdometryRig& noise);

}  // namespace azimuth
