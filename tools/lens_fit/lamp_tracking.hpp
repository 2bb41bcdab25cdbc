#pragma once
// Which lamp of which image is which: lamps are tracked through the images of a drive by prediction.

#include <vector>

#include "tools/lens_fit/lens_fit.hpp"

namespace azimuth {

/// A bright spot that may be a lamp.
struct SeenLamp {
  Pixel pixel = Pixel::Zero();
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Identity();
};
using SeenLamps = std::vector<SeenLamp>;  ///< in one image

/// How far a lamp may be from where it is expected, and with how much error of lens and path that expectation counts.
struct TrackingGate {
  double gate_px = 15.0, sigma_px = 3.0;
};

/// What to begin a fit with.
struct LensFitStart {
  LensDrive drive;     ///< sightings of lamps that were seen often
  LensSolution start;  ///< the lens as given, path and lamps as followed through the images
  double cost = 0.0;   ///< mean of the squares, in units of the gate: near 1 where hardly anything was recognised
};

/// Goes through the images in their order. In each, odometry and the lamps known so far say where the robot is, lamps
/// that are where they were expected are those, and others are new ones unless they are near the horizon.
/// Deterministic.
LensFitStart map_lamps(const std::vector<Motion>& motions, const std::vector<SeenLamps>& images, const Lens& lens,
                       double lamp_height_m, const TrackingGate& trust);

}  // namespace azimuth
