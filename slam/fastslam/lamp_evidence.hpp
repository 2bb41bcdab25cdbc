#pragma once
// What speaks for a landmark being a lamp, and not what a crowd of reflections looks like by chance.

#include <cstddef>
#include <limits>

#include "slam/fastslam/lamp_view.hpp"

namespace azimuth {

/// Reflections of an image as chance would have them: anywhere in view, all directions alike.
class Reflections {
 public:
  Reflections() = default;
  /// `count` of them, as far as `max_zenith_rad` from the zenith.
  Reflections(std::size_t count, double max_zenith_rad);

  /// ln of how many to expect per steradian.
  double log_per_sr() const { return log_per_sr_; }
  /// ln of how many to expect per unit of azimuth and zenith where `seen` is.
  double log_density(const LampSighting& seen) const;

 private:
  double log_per_sr_ = 0.0;
};

/// A sequential test of Wald's: ln of how much likelier it is that the landmark is a lamp than that its sightings were
/// reflections, which happened to be where it was expected. Between both bounds nothing is known. A crowd of
/// reflections proves a landmark once in so many times only, however long it goes on, as long as what is missed counts
/// wherever what is seen does.
class LampEvidence {
 public:
  static constexpr double kProof = 9.2;  ///< ln 10,000: there are many landmarks, and a map of each particle

  /// Seen where it was expected with `log_likelihood`, as likely as `log_reflection` by chance.
  void seen(double log_likelihood, double log_reflection) { add(log_likelihood - log_reflection); }
  /// In view, but not seen; `log_miss` is ln of how likely that is of a lamp.
  void missed(double log_miss) { add(log_miss); }

  /// By its name.
  static LampEvidence certain() {
    LampEvidence evidence;
    evidence.log_odds_ = kProven;
    return evidence;
  }

  bool proven() const { return log_odds_ == kProven; }
  bool refuted() const { return log_odds_ < -kProof; }

 private:
  static constexpr double kProven = std::numeric_limits<double>::infinity();  // nothing takes it back

  void add(double log_ratio) {
    log_odds_ += log_ratio;
    if (log_odds_ > kProof) log_odds_ = kProven;
  }

  double log_odds_ = 0.0;
};

}  // namespace azimuth
