#pragma once
#include <vector>

#include "slam/perception/sift/key_point.hpp"
#include "slam/perception/sift/sift_settings.hpp"

namespace azimuth {

/// Chooses the features of an image: strong ones, since those are found again, from all around the robot, since
/// bearings that lie on one side say little about its position.
///
/// Every sector of azimuth is entitled to an equal share of the target; what sectors leave over goes to the strongest
/// of the others. The order in which key points come does not matter.
///
/// Thread contract: thread-bound. Nothing allocates in the steady state.
class FeatureSelection {
 public:
  /// `centre_px`: of the optical axis, along x and along y of the working image.
  FeatureSelection(const SiftSettings& settings, double centre_px);

  /// Leaves at most target_count of them, strongest first.
  void select(std::vector<KeyPoint>& key_points);

 private:
  std::size_t sector(const KeyPoint& point) const;

  int target_count_;
  std::size_t sectors_;
  float centre_px_;
  std::vector<int> chosen_in_;
  std::vector<KeyPoint> chosen_, left_over_;
};

}  // namespace azimuth
