#pragma once
// A robot set down anywhere in a mapped world, which drives and looks around.

#include <functional>
#include <optional>
#include <vector>

#include "slam/localisation/relocaliser.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {

/// What stands there, and how the robot sees it.
struct KidnapWorld {
  std::vector<KnownLandmark> truth;
  Eigen::Vector2d low_m{0.0, 0.0}, high_m{14.0, 10.0};  ///< where the robot drives
  double camera_height_m = 0.0;
  double range_m = 6.0;          ///< of landmarks without height
  double max_zenith_rad = 1.22;  ///< of those with
  double sigma_rad = 0.0262;
  double detection = 0.9, clutter_per_image = 0.5;
  bool names = false, kinds = false;
  double map_sigma_m = 0.05;
  std::optional<double> reach_m{};  ///< it is known to be no farther than this from where it is set down

  CameraView view() const;
  /// The map: each landmark a little off its place.
  std::vector<KnownLandmark> map(RandomDraws& draws) const;
  std::vector<SeenDirection> look(const Pose2& T_map_body, RandomDraws& draws) const;
};

/// 4 x 4 lamps under a ceiling of 6.5 m, each up to `off_m` off a grid of 9 x 4.5 m.
KidnapWorld lamp_hall(RandomDraws& draws, double off_m);

/// 24 things in a lab of 14 x 10 m.
KidnapWorld lab(RandomDraws& draws);

struct Kidnapping {
  bool found = false, wrong = false;  ///< wrong: a pose was called found that is not
  double after_s = 0.0;
  double error_m = 0.0, error_rad = 0.0;
  bool ambiguous = false;  ///< at the end
  double update_us = 0.0;  ///< mean of an image
};
/// Up to `seconds` of driving at half a metre a second, five images a second, until it is found.
Kidnapping kidnap(const KidnapWorld& world, const RelocalisationSettings& settings, double seconds, RandomDraws& draws);

}  // namespace azimuth
