#pragma once
// Evidence that a landmark is a lamp and not a chance pattern of reflections.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "slam/fastslam/lamp_view.hpp"

namespace azimuth {

/// Model of an image's reflections by chance: uniformly distributed over the field of view.
class Reflections {
 public:
  Reflections() = default;
  /// `count` reflections within `max_zenith_rad` of the zenith.
  Reflections(std::size_t count, double max_zenith_rad)
      : log_per_sr_(std::log(static_cast<double>(count) / (2.0 * kPi * (1.0 - std::cos(max_zenith_rad))))) {}

  /// ln of the expected number per steradian.
  double log_per_sr() const { return log_per_sr_; }
  /// ln of the expected number per unit of azimuth and zenith at the direction of `seen`.
  double log_density(const LampSighting& seen) const {
    constexpr double kNearZenith = 0.01;
    return log_per_sr_ + std::log(std::max(seen.sin_zenith(), kNearZenith));
  }

 private:
  double log_per_sr_ = 0.0;
};

/// Wald's sequential test: the log-likelihood ratio of a landmark being a lamp to its detections being reflections that
/// happened to be at the predicted direction. Between the two bounds the test is undecided. Reflections prove a
/// landmark with a probability of at most exp(-kProof), however long the test runs, provided that misses are counted
/// wherever detections are.
class LampEvidence {
 public:
  static constexpr double kProof = 9.2;  ///< ln 10,000: there are many landmarks, and each particle has a map

  /// A detection at the predicted direction: ln of its density for the lamp and for a chance reflection.
  void seen(double log_likelihood, double log_reflection) { add(log_likelihood - log_reflection); }
  /// A miss within the field of view; `log_miss` is ln of its probability for a lamp.
  void missed(double log_miss) { add(log_miss); }

  /// Evidence for a landmark with an identity.
  static LampEvidence certain() {
    LampEvidence evidence;
    evidence.log_odds_ = kProven;
    return evidence;
  }

  bool proven() const { return log_odds_ == kProven; }
  bool refuted() const { return log_odds_ < -kProof; }

 private:
  static constexpr double kProven = std::numeric_limits<double>::infinity();  // Final: no further evidence changes it

  void add(double log_ratio) {
    log_odds_ += log_ratio;
    if (log_odds_ > kProof) log_odds_ = kProven;
  }

  double log_odds_ = 0.0;
};

}  // namespace azimuth
