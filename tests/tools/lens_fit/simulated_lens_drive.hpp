#pragma once
#include <cstdint>

#include "tools/lens_fit/lamp_tracking.hpp"

namespace azimuth::test {

/// A drive below lamps, seen through a known lens. The noise of pixels, odometry and heights agrees with the priors.
struct SimulatedLensDrive {
  LensSolution truth;
  LensPriors priors;  ///< With the measured height of the lamps.
  std::vector<Motion> motions;
  std::vector<SeenLamps> images;
};

struct LensDriveOptions {
  std::uint64_t seed = 1;
  int frames = 160, lamps = 14;
  double sigma_px = 0.2;
  CameraTilt tilt{};
};

SimulatedLensDrive simulated_lens_drive(const LensDriveOptions& options);

/// A polynomial lens with a radius of about 238 px per rad of theta.
Lens known_lens();

}  // namespace azimuth::test
