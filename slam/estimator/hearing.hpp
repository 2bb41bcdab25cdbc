#pragma once
#include <Eigen/Core>

#include "slam/estimator/image_troubles.hpp"
#include "slam/estimator/judgement.hpp"

namespace azimuth {

/// How well a filter hears its map: how far was driven since a landmark was recognised, and how often bearings
/// contradicted what is known since then. Health is judged by it.
///
/// Thread contract: thread-bound.
struct Hearing {
  double path_m = 0.0;             ///< driven so far
  double last_recognised_m = 0.0;  ///< of it, when a mapped landmark was recognised last
  int contradictions = 0;          ///< bearings or images, since one agreed
  int deaf_streaks = 0;            ///< times the pose was made vaguer because of that, since then
  ImageTroubles troubles;

  void recognised() { last_recognised_m = path_m; }
  /// What was seen agrees with the map, or the pose is known anew.
  void agreed() {
    contradictions = deaf_streaks = 0;
    recognised();
  }

  /// After `at_path_m` of driving; what is known of map and camera is left to the caller.
  Evidence evidence(const Eigen::Matrix3d& pose_covariance, double at_path_m) const {
    Evidence evidence;
    evidence.pose_covariance = pose_covariance;
    evidence.unrecognised_m = at_path_m - last_recognised_m;
    evidence.deaf_sightings = contradictions;
    evidence.deaf_streaks = deaf_streaks;
    evidence.troubled_images = troubles.in_row();
    evidence.trouble = troubles.last();
    return evidence;
  }
};

}  // namespace azimuth
