#pragma once
// A run whose bearings have no names through the hypotheses, as it would go live, and what they say of the past at the
// end. Names that a run has are used to judge, and for nothing else.

#include <limits>
#include <vector>

#include "slam/hypotheses/nameless.hpp"
#include "tests/support/smoothed_run.hpp"

namespace azimuth {

/// How the rig's noise and floors become a beam's.
NamelessSettings nameless_settings_for(const Rig& rig, const Scene& scene, const SmootherSettings& smoother);

struct NamelessRun {
  std::vector<EstimateRecord> online, smoothed;  ///< one for each bearing set
  std::vector<double> step_us;                   ///< CPU time of all threads, of each set that was used
  std::vector<double> gaps;                      ///< of each set that was used
  double energy = 0.0;
};
struct NamelessMapScore {
  int landmarks = 0, mapped = 0, duplicates = 0, assigned = 0, wrong = 0, bearings = 0;
};

NamelessRun nameless_run(const Run& run, const Rig& rig, const NamelessSettings& settings, Workers& workers,
                         NamelessMapScore& score);

}  // namespace azimuth
