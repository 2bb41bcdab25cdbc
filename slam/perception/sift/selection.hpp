#pragma once
#include <vector>

#include "slam/perception/sift/key_point.hpp"
#include "slam/perception/sift/sift_settings.hpp"

namespace azimuth {

/// Chooses the features of an image: strong ones, since those are found again, from all around the robot, since
/// bearings that lie on one side say little about its position.
///
/// Going from the strongest to the weakest, a key point is chosen unless a sector's worth of azimuth about it holds its
/// share of the target already; what room that leaves goes to the strongest of the others. Sectors are about each key
/// point and not fixed in the image, so that a turn of the robot changes nothing. Nor does the order of the key points.
///
/// Thread contract: thread-bound. Nothing allocates in the steady state.
class FeatureSelection {
 public:
  /// `centre_px`: of the optical axis, along x and along y of the working image.
  FeatureSelection(const SiftSettings& settings, double centre_px);

  /// Leaves at most target_count of them, strongest first.
  void select(std::vector<KeyPoint>& key_points);

 private:
  struct Candidate {
    KeyPoint point;
    float azimuth_rad = 0.0F;  ///< in the image
  };

  void order(const std::vector<KeyPoint>& key_points);
  bool has_room(const Candidate& candidate) const;

  std::size_t target_count_, share_;
  float half_sector_rad_, centre_px_;
  std::vector<Candidate> candidates_, chosen_, left_over_;
};

}  // namespace azimuth
