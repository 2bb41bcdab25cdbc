#pragma once
// Reflections among lamps, or instead of them, and what an estimator makes of such a drive.

#include <string_view>

#include "slam/estimator/estimator.hpp"
#include "tests/support/lamp_run.hpp"

namespace azimuth {

/// What is seen beside the lamps.
struct LampCrowd {
  const char* title;
  bool lamps;                 ///< are on
  int anywhere;               ///< reflections of an image, never twice in the same place
  bool on_the_robot = false;  ///< one that is fixed to it: what its own lamp throws on a guard
};
/// simulated_hall() of this seed with the crowd in all of its images.
LampRun crowded_hall(const LampCrowd& crowd, int seed);

/// What came of one drive, or of several together.
struct CrowdOutcome {
  int runs = 0, images = 0, tracking = 0;
  int lamps = 0, phantoms = 0;  ///< of the maps at the end
  double mean_square_m2 = 0.0;  ///< of the position after the best rigid motion; of all images
  double anees = 0.0;           ///< of the pose, 3 degrees of freedom, from the first pose on
  std::string_view reason;      ///< of the last estimate

  void add(const CrowdOutcome& other);
  double rmse_m() const;
};
CrowdOutcome follow(const LampRun& run, Estimator& estimator);
void print(const LampCrowd& crowd, const CrowdOutcome& outcome);

}  // namespace azimuth
