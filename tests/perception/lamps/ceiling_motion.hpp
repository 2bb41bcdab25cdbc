#pragma once
// How spots in a ceiling move from image to image when the robot does.

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "slam/camera/image_axes.hpp"
#include "slam/geometry/pose2.hpp"

namespace azimuth::test {

/// The fisheye behind `ceiling-tubes`, as its owner calibrated it: r = f (theta + k1 theta^3), the optical axis tilted
/// towards the right of the image. Points of the ceiling are in units of its height above the camera.
class TiltedFisheye {
 public:
  /// Nothing for what is lower than kLowest_rad.
  std::optional<Eigen::Vector2d> ceiling(const Pixel& pixel) const;
  Pixel pixel(const Eigen::Vector2d& ceiling) const;

  static constexpr double kLowest_rad = 0.3;

 private:
  static constexpr double kHalved = 4.05;  // the images are that much smaller than those it was calibrated with
  static constexpr double kFocalLength_px = 765.0 / kHalved, kK1 = 0.015;
  static constexpr double kCentreU_px = 1280.0 / kHalved, kCentreV_px = 920.0 / kHalved;
  static constexpr double kTilt_rad = 22.0 * kPi / 180.0;
};

/// A spot before a motion and after it.
struct SpotPair {
  std::size_t before = 0, after = 0;
};

/// Which spots are the same, and the motion that says so.
struct CeilingMotion {
  Pose2 T_after_before;  ///< of the ceiling: three numbers for all spots together
  std::vector<SpotPair> pairs;
};

/// Fits the motion of a robot on a flat floor to where spots are before it and after it, by their distances in pixels
/// and so that a few wrong pairs do not matter. A pair is each other's nearest and within 3 pixels in the end.
/// `guess`: of the motion, e.g. the last one.
CeilingMotion fit_motion(const TiltedFisheye& camera, std::span<const Pixel> before, std::span<const Pixel> after,
                         const Pose2& guess);

/// Where a spot will be; nothing where it is too low.
std::optional<Pixel> moved(const TiltedFisheye& camera, const Pixel& before, const Pose2& T_after_before);

}  // namespace azimuth::test
