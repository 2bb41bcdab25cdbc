#pragma once
#include <cstdint>

#include "tools/lens_fit/lamp_tracking.hpp"

namespace azimuth::test {

/// A drive below lamps through a known lens, with noise of pixels, odometry and heights as claimed.
struct SimulatedLensDrive {
  LensSolution truth;
  LensPriors priors;  ///< with the height as it was measured
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

/// r = 238 px theta, nearly, as a polynomial.
Lens known_lens();

}  // namespace azimuth::test
