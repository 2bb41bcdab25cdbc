#pragma once
#include <cstddef>
#include <span>

namespace azimuth {

/// A sighting that may be of a target (a landmark or a candidate), with its log-likelihood.
struct LampPair {
  int sighting = 0;
  int target = 0;
  double log_likelihood = 0.0;
};

inline constexpr int kNoTarget = -1;

/// All that association goes by, for one particle. Pairs are in the order of sightings; pairs that are less likely than
/// something new are left out.
struct LampPairs {
  std::span<const LampPair> pairs;
  std::span<const double> log_new;  ///< of each sighting, ln P_new
  std::size_t targets = 0;
};

/// Decides which sighting is of which target; each target is used at most once. Association is no business of the
/// filter's (CONTRIBUTING, rule 3).
class LampAssociator {
 public:
  virtual ~LampAssociator() = default;
  /// Writes one target, or kNoTarget, for each sighting.
  virtual void associate(const LampPairs& pairs, std::span<int> target_of) = 0;
};

}  // namespace azimuth
