#pragma once
#include <optional>

#include "slam/localisation/relocalisation_settings.hpp"

namespace azimuth {

/// Driven: what was seen then should be seen still.
inline constexpr double kMoment_m = 1.5;

/// How far an image shows what it should.
struct ImageAgreement {
  int expected = 0;     ///< landmarks in view that were seen a moment ago
  int bearings = 0;     ///< in the image
  int explained = 0;    ///< of them, those of some landmark where it should be
  double chance = 0.0;  ///< that a bearing of anything is explained by accident
  /// Instead of the numbers, where more is known of what an image should show: ln of how much likelier it is of
  /// elsewhere. Of the numbers `expected` alone counts then.
  std::optional<double> log_odds = {};
};

/// Notices when a robot is not where it is thought to be (carried away, wheels spinning on the spot): the images go on
/// to show things, but not those which were there a moment ago. It is a sequential test: the log odds of being lost
/// grow with each landmark that is not found again, shrink with each one that is, and are never less than none.
///
/// Thread contract: thread-bound.
class AgreementWatch {
 public:
  explicit AgreementWatch(const RelocalisationSettings& settings) : settings_(settings) {}

  void add(const ImageAgreement& image);
  /// Enough to leave the map as it is until this is settled.
  bool doubts() const { return settings_.lost_log_odds > 0.0 && log_odds_ > settings_.doubt_log_odds; }
  bool is_lost() const { return settings_.lost_log_odds > 0.0 && log_odds_ > settings_.lost_log_odds; }
  /// Nothing speaks for being lost.
  bool is_certain() const { return log_odds_ <= 0.0; }
  void settle() { log_odds_ = 0.0; }

 private:
  RelocalisationSettings settings_;
  double usual_share_ = 0.7;  ///< of what is looked for, found again
  double log_odds_ = 0.0;
};

}  // namespace azimuth
