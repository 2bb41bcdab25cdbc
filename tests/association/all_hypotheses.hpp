#pragma once
// What JointCompatibility searches for, found by trying everything.

#include <span>
#include <vector>

#include "slam/association/joint_compatibility.hpp"

namespace azimuth {

struct JointHypothesis {
  double log_likelihood = 0.0;
  std::vector<int> landmark;  ///< of each measurement; kNoLandmark: something new
};

/// Every hypothesis that uses no landmark twice, passes the individual gates and, pairing by pairing, the joint test;
/// likeliest first. Its likelihood is the joint normal density of all paired innovations, from a dense factorisation,
/// times the density of what is new.
std::vector<JointHypothesis> all_hypotheses(std::span<const MeasuredAzimuth> measured,
                                            const PredictedAzimuths& predicted, const JointGates& gates);

}  // namespace azimuth
