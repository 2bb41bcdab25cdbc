#pragma once
#include <algorithm>

namespace azimuth {

/// Running mean and variance of the evidence that recent images gave for the robot's place (ln of odds).
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
  /// Whether images nearly always support the believed place. Only then does an image that does not support this place
  /// mean that the robot is elsewhere; otherwise the map is wrong in parts, or landmarks are often occluded.
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
