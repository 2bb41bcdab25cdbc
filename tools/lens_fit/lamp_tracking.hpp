#pragma once
// Data association of lamps: tracks lamps through the images of a drive by prediction.

#include <vector>

#include "tools/lens_fit/lens_fit.hpp"

namespace azimuth {

/// A bright spot that may be a lamp.
struct SeenLamp {
  Pixel pixel = Pixel::Zero();
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Identity();
};
using SeenLamps = std::vector<SeenLamp>;  ///< the detections in one image

/// Gate of the data association: largest distance of a lamp from its predicted pixel, and standard deviation of the
/// prediction due to errors of lens and path.
struct TrackingGate {
  double gate_px = 15.0, sigma_px = 3.0;
};

/// Starting point of a lens fit.
struct LensFitStart {
  LensDrive drive;     ///< observations of lamps that were seen often
  LensSolution start;  ///< the given lens, with path and lamps from tracking
  double cost = 0.0;   ///< mean squared distance in units of the gate; near 1 if hardly any lamp was recognised
};

/// Processes the images in order. For each image, odometry and the known lamps give the robot's pose. Detections near a
/// predicted lamp are assigned to that lamp. Other detections become new lamps unless they are near the horizon.
/// `motions`: one per image, from the previous image. Deterministic.
LensFitStart map_lamps(const std::vector<Motion>& motions, const std::vector<SeenLamps>& images, const Lens& lens,
                       double lamp_height_m, const TrackingGate& trust);

}  // namespace azimuth
