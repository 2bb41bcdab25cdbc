#pragma once
#include <cstddef>
#include <span>

namespace azimuth {

/// A detection that may be of a target (a landmark or a candidate), with its log-likelihood.
struct LampPair {
  int sighting = 0;
  int target = 0;
  double log_likelihood = 0.0;
};

inline constexpr int kNoTarget = -1;

/// The input of data association for one particle. Pairs are in the order of detections; pairs less likely than a new
/// object are left out.
struct LampPairs {
  std::span<const LampPair> pairs;
  std::span<const double> log_new;  ///< Of each detection: ln P_new
  std::size_t targets = 0;
};

/// Data association: decides which detection is of which target. Each target is used at most once. This interface
/// separates data association from the filter (CONTRIBUTING, rule 3).
class LampAssociator {
 public:
  virtual ~LampAssociator() = default;
  /// Writes for each detection one target or kNoTarget.
  virtual void associate(const LampPairs& pairs, std::span<int> target_of) = 0;
};

}  // namespace azimuth
