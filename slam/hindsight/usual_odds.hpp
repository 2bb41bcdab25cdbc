#pragma once
#include <algorithm>

namespace azimuth {

/// What images used to say for the place where the robot was: ln of odds, of the newest ones.
///
/// Thread contract: thread-bound.
class UsualOdds {
 public:
  void add(double log_odds) {
    images_ = std::min(images_ + 1, kRemembered);
    const double off = log_odds - mean_;
    mean_ += off / images_;
    variance_ += (off * (log_odds - mean_) - variance_) / images_;
  }
  double mean() const { return mean_; }
  /// Only where images nearly always speak for the place, one that does not says that it is another: elsewhere the map
  /// is wrong in parts, or things are hidden more often than not.
  bool nearly_all_positive() const {
    return images_ >= kFewest && mean_ > 0.0 && mean_ * mean_ > kSigmas * kSigmas * variance_;
  }

 private:
  static constexpr int kRemembered = 50, kFewest = 20;
  static constexpr double kSigmas = 2.0;
  int images_ = 0;
  double mean_ = 0.0, variance_ = 0.0;
};

}  // namespace azimuth
