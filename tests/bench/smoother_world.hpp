#pragma once
// The problem of the smoother's benchmarks: a long drive with a narrow field of view, as large as a recording of 15
// min.

#include "tests/support/named_drive.hpp"

namespace azimuth::bench {

inline NamedDrive long_drive(int images) {
  return named_drive({.images = images, .step_m = 0.15, .view_rad = 1.05, .most_bearings = 2, .sigma_rad = 0.0436});
}

/// The smoother after `images` images.
inline Smoother driven(DriveFeeder& feeder, int images, const SmootherSettings& settings) {
  Smoother smoother(settings);
  for (int i = 0; i < images; ++i) {
    feeder.feed(smoother);
    smoother.optimise();
  }
  return smoother;
}

}  // namespace azimuth::bench
