#pragma once
// A run whose bearings have no names through the hypotheses, as it would go live, and what they say of the past at the
// end. Names that a run has are used to judge, and for nothing else.

#include <optional>
#include <string>
#include <vector>

#include "slam/hypotheses/nameless.hpp"
#include "tests/support/smoothed_run.hpp"

namespace azimuth {

/// How the rig's view, noise and floors become a beam's.
NamelessSettings nameless_settings_for(const Rig& rig);

struct NamelessRun {
  /// Of an image that was used.
  struct Used {
    std::size_t record = 0;  ///< in `online`
    Trust trust;
    std::string trace;  ///< what the trust comes of
  };
  std::vector<EstimateRecord> online, smoothed, odometry;  ///< one for each bearing set
  std::vector<Trust> trust;                                ///< likewise
  std::vector<Used> used;
  std::vector<double> step_us;  ///< CPU time of all threads, of each set that was used
  double energy = 0.0;
};
struct NamelessMapScore {
  int landmarks = 0, mapped = 0, duplicates = 0, assigned = 0, wrong = 0, bearings = 0;
};

/// Online, smoothed, and what odometry alone says, with what it knows of itself.
NamelessRun nameless_run(const Run& run, const Rig& rig, const NamelessSettings& settings, Workers& workers,
                         NamelessMapScore& score);

/// By how much each record is wrong, (x, y, heading) in the map, relative to the first one; nothing where there is no
/// truth.
std::vector<std::optional<Eigen::Vector3d>> errors_of_each(const Run& run, const std::vector<EstimateRecord>& records);

/// The share of live poses that are said to be trusted, and the ANEES of these.
struct TrustScore {
  double share = 0.0, anees = 0.0;
};
TrustScore trust_score(const Run& run, const NamelessRun& result);

}  // namespace azimuth
