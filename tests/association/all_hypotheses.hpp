#pragma once
// An exhaustive search for the hypotheses that JointCompatibility searches for.

#include <span>
#include <vector>

#include "slam/association/joint_compatibility.hpp"

namespace azimuth {

struct JointHypothesis {
  double log_likelihood = 0.0;
  std::vector<int> landmark;  ///< Landmark of each measurement; kNoLandmark: something new
};

/// Every hypothesis that uses no landmark twice and passes the individual gates and, after each further pair, the joint
/// test; the likeliest first. The likelihood of a hypothesis is the joint normal density of all paired innovations,
/// computed with a dense factorisation, times the density of new landmarks for each unpaired measurement.
std::vector<JointHypothesis> all_hypotheses(std::span<const MeasuredAzimuth> measured,
                                            const PredictedAzimuths& predicted, const JointGates& gates);

}  // namespace azimuth
