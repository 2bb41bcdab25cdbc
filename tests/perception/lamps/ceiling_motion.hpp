#pragma once
// Motion of the spots of a ceiling from image to image.

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "slam/camera/image_axes.hpp"
#include "slam/geometry/pose2.hpp"

namespace azimuth::test {

/// The fisheye camera of `ceiling-tubes`, as calibrated by its owner: r = f (theta + k1 theta^3), with the optical axis
/// tilted towards the right of the image. Points of the ceiling are in units of its height above the camera.
class TiltedFisheye {
 public:
  /// The point of the ceiling; no value below the elevation kLowest_rad.
  std::optional<Eigen::Vector2d> ceiling(const Pixel& pixel) const;
  Pixel pixel(const Eigen::Vector2d& ceiling) const;

  static constexpr double kLowest_rad = 0.3;

 private:
  static constexpr double kHalved = 4.05;  // scale of the images relative to the calibration images
  static constexpr double kFocalLength_px = 765.0 / kHalved, kK1 = 0.015;
  static constexpr double kCentreU_px = 1280.0 / kHalved, kCentreV_px = 920.0 / kHalved;
  static constexpr double kTilt_rad = 22.0 * kPi / 180.0;
};

/// Indices of the same spot before and after a motion.
struct SpotPair {
  std::size_t before = 0, after = 0;
};

/// Matched spots, and the motion that matches them.
struct CeilingMotion {
  Pose2 T_after_before;  ///< motion of the ceiling, with three parameters for all spots
  std::vector<SpotPair> pairs;
};

/// Fits the motion of a robot on a flat floor to the spots before and after it, minimising robustly weighted distances
/// in pixels. Pairs are mutual nearest neighbours within 3 pixels at the end. `guess`: an initial motion, e.g. the
/// previous one.
CeilingMotion fit_motion(const TiltedFisheye& camera, std::span<const Pixel> before, std::span<const Pixel> after,
                         const Pose2& guess);

/// Predicted position of a spot; no value if it is too low.
std::optional<Pixel> moved(const TiltedFisheye& camera, const Pixel& before, const Pose2& T_after_before);

}  // namespace azimuth::test
