#pragma once
// Drives with reflections among the lamps, or instead of lamps, and the estimator's result on such drives.

#include <string_view>

#include "slam/estimator/estimator.hpp"
#include "tests/support/lamp_run.hpp"

namespace azimuth {

/// Reflections that the camera sees in addition to the lamps.
struct LampCrowd {
  const char* title;
  bool lamps;                 ///< whether the lamps are on
  int anywhere;               ///< number of reflections per image, each at a new random place
  bool on_the_robot = false;  ///< adds a reflection fixed to the robot, such as its own lamp on a guard
};
/// simulated_hall() of this seed, with the crowd in each image.
LampRun crowded_hall(const LampCrowd& crowd, int seed);

/// Result of one drive, or of several drives together.
struct CrowdOutcome {
  int runs = 0, images = 0, tracking = 0;
  int lamps = 0, phantoms = 0;  ///< mapped landmarks that are lamps and that are not, at the end
  double mean_square_m2 = 0.0;  ///< mean squared position error over all images, after the best rigid alignment
  double anees = 0.0;           ///< of the pose relative to the first pose, 3 degrees of freedom
  std::string_view reason;      ///< of the last estimate

  void add(const CrowdOutcome& other);
  double rmse_m() const;
};
CrowdOutcome follow(const LampRun& run, Estimator& estimator);
void print(const LampCrowd& crowd, const CrowdOutcome& outcome);

}  // namespace azimuth
