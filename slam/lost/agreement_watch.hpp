#pragma once
#include <optional>

#include "slam/localisation/relocalisation_settings.hpp"

namespace azimuth {

/// Distance driven within which landmarks seen before should still be seen.
inline constexpr double kMoment_m = 1.5;

/// The landmarks that an image should show, and how many of them it does show.
struct ImageAgreement {
  int expected = 0;     ///< Landmarks in view that were seen a moment ago
  int bearings = 0;     ///< Bearings in the image
  int explained = 0;    ///< Bearings that agree with some predicted landmark
  double chance = 0.0;  ///< Probability that a bearing agrees by accident
  /// Set where a better model of the image exists: ln P(image | robot elsewhere) / P(image | robot here). Of the
  /// numbers above only `expected` is used then.
  std::optional<double> log_odds = {};
};

/// Detects that a robot is not where the filter believes (carried away, or wheels spinning on the spot): images still
/// show landmarks, but not those that were there a moment ago. A sequential test: the log odds of being lost grow with
/// each landmark that is missed, shrink with each one that is found, and never fall below 0.
///
/// Thread contract: thread-bound.
class AgreementWatch {
 public:
  explicit AgreementWatch(const RelocalisationSettings& settings) : settings_(settings) {}

  void add(const ImageAgreement& image);
  /// The evidence suffices to stop changing the map until the doubt is resolved.
  bool doubts() const { return settings_.lost_log_odds > 0.0 && log_odds_ > settings_.doubt_log_odds; }
  bool is_lost() const { return settings_.lost_log_odds > 0.0 && log_odds_ > settings_.lost_log_odds; }
  /// There is no evidence for being lost.
  bool is_certain() const { return log_odds_ <= 0.0; }
  void settle() { log_odds_ = 0.0; }

 private:
  RelocalisationSettings settings_;
  double usual_share_ = 0.7;  ///< Usual share of the expected landmarks that are found
  double log_odds_ = 0.0;
};

}  // namespace azimuth
