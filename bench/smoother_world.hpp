#pragma once
// A long drive in a narrow view, of the size of a recorded quarter of an hour: what the smoother's benchmarks solve.

#include "tests/support/named_drive.hpp"

namespace azimuth::bench {

inline NamedDrive long_drive(int images) {
  return named_drive({.images = images, .step_m = 0.15, .view_rad = 1.05, .most_bearings = 2, .sigma_rad = 0.0436});
}

/// The smoother as it is after so many images.
inline Smoother driven(DriveFeeder& feeder, int images, const SmootherSettings& settings) {
  Smoother smoother(settings);
  for (int i = 0; i < images; ++i) {
    feeder.feed(smoother);
    smoother.optimise();
  }
  return smoother;
}

}  // namespace azimuth::bench
