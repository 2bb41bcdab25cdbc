#pragma once
// A robot that is put down anywhere in a mapped world, then drives and observes.

#include <functional>
#include <optional>
#include <vector>

#include "slam/localisation/relocaliser.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {

/// The landmarks of the world and the camera's properties.
struct KidnapWorld {
  std::vector<KnownLandmark> truth;
  Eigen::Vector2d low_m{0.0, 0.0}, high_m{14.0, 10.0};  ///< Corners of the area in which the robot drives
  double camera_height_m = 0.0;
  double range_m = 6.0;          ///< Range of landmarks without a height
  double max_zenith_rad = 1.22;  ///< Largest zenith angle of landmarks with a height
  double sigma_rad = 0.0262;
  double detection = 0.9, clutter_per_image = 0.5;
  bool names = false, kinds = false;
  double map_sigma_m = 0.05;
  /// Known limit on the robot's distance from the place where it is put down
  std::optional<double> reach_m{};

  CameraView view() const;
  /// The map: each landmark with an error drawn from `map_sigma_m`.
  std::vector<KnownLandmark> map(RandomDraws& draws) const;
  std::vector<SeenDirection> look(const Pose2& T_map_body, RandomDraws& draws) const;
};

/// 4 x 4 lamps under a ceiling of 6.5 m, each up to `off_m` off a regular grid with a spacing of 9 x 4.5 m.
KidnapWorld lamp_hall(RandomDraws& draws, double off_m);

/// A lab of 14 x 10 m with 24 landmarks.
KidnapWorld lab(RandomDraws& draws);

struct Kidnapping {
  bool found = false, wrong = false;  ///< `wrong`: a reported pose is not the true one
  double after_s = 0.0;
  double error_m = 0.0, error_rad = 0.0;
  bool ambiguous = false;  ///< Whether the pose is ambiguous at the end
  double update_us = 0.0;  ///< Mean time of an image
};
/// Drives for up to `seconds` at half a metre per second with five images per second, until the robot is relocalised.
Kidnapping kidnap(const KidnapWorld& world, const RelocalisationSettings& settings, double seconds, RandomDraws& draws);

}  // namespace azimuth
