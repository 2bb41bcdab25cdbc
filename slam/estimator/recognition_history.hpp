#pragma once
#include <Eigen/Core>

#include "slam/estimator/judgement.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Counts consecutive useless images. A frozen image does not count while the robot stands still.
///
/// Thread contract: thread-bound.
class ImageTroubles {
 public:
  /// Adds an image, taken after `path_m` of driving.
  void add(ImageTrouble trouble, double path_m) {
    const bool moved = path_m > last_image_m_;
    last_image_m_ = path_m;
    last_ = trouble;
    if (trouble == ImageTrouble::none)
      in_row_ = 0;
    else if (trouble != ImageTrouble::frozen || moved)
      ++in_row_;
  }
  int in_row() const { return in_row_; }
  ImageTrouble last() const { return last_; }

 private:
  int in_row_ = 0;
  ImageTrouble last_ = ImageTrouble::none;
  double last_image_m_ = 0.0;
};

/// How well bearings agree with a filter's map: the distance driven since a landmark was last recognised, and the
/// number of contradictions since then. Health is judged by these numbers.
///
/// Thread contract: thread-bound.
struct RecognitionHistory {
  double path_m = 0.0;             ///< Distance driven so far
  double last_recognised_m = 0.0;  ///< `path_m` when a mapped landmark was last recognised
  int contradictions = 0;          ///< Contradicting bearings or images since the last agreement
  int inflations = 0;              ///< Inflations of the pose covariance by these contradictions
  ImageTroubles troubles;

  void recognised() { last_recognised_m = path_m; }
  /// Bearings agree with the map, or the pose was found anew by relocalisation.
  void agreed() {
    contradictions = inflations = 0;
    recognised();
  }

  /// The evidence after `at_path_m` of driving. The caller fills in what is known of map and camera.
  Evidence evidence(const Eigen::Matrix3d& pose_covariance, double at_path_m) const {
    Evidence evidence;
    evidence.pose_covariance = pose_covariance;
    evidence.unrecognised_m = at_path_m - last_recognised_m;
    evidence.contradictions = contradictions;
    evidence.inflations = inflations;
    evidence.troubled_images = troubles.in_row();
    evidence.trouble = troubles.last();
    return evidence;
  }
};

}  // namespace azimuth
