#pragma once
#include <vector>

#include "slam/perception/sift/key_point.hpp"
#include "slam/perception/sift/sift_settings.hpp"

namespace azimuth {

/// Selects the features of an image. Strong key points are preferred, since they are found again. They must come from
/// all around the robot, since bearings from one side constrain its position poorly.
///
/// From the strongest to the weakest, a key point is chosen unless the sector of azimuths centred on it already holds
/// its share of the target count. Remaining places go to the strongest of the other key points. Sectors are centred on
/// each key point and not fixed in the image, so the choice does not depend on the robot's heading, nor on the order of
/// the key points.
///
/// Thread contract: thread-bound. Nothing allocates in the steady state.
class FeatureSelection {
 public:
  /// `centre_px`: coordinate of the optical axis in the working image, the same along x and y.
  FeatureSelection(const SiftSettings& settings, double centre_px);

  /// Keeps at most target_count key points, strongest first.
  void select(std::vector<KeyPoint>& key_points);

 private:
  struct Candidate {
    KeyPoint point;
    float azimuth_rad = 0.0F;  ///< In the image
  };

  void order(const std::vector<KeyPoint>& key_points);
  bool has_room(const Candidate& candidate) const;

  std::size_t target_count_, share_;
  float half_sector_rad_, centre_px_;
  std::vector<Candidate> candidates_, chosen_, left_over_;
};

}  // namespace azimuth
