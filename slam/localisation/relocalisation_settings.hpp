#pragma once
#include <numbers>

namespace azimuth {

/// Settings of the search for a lost robot in a known map.
struct RelocalisationSettings {
  // When the robot counts as lost
  double doubt_log_odds = 2.0;  ///< Log odds of being lost above which the map is not changed
  double lost_log_odds = 10.0;  ///< Log odds above which the search starts; 0: never

  // When the robot counts as found
  double found_probability = 0.999;  ///< Required probability of one pose, against all others and against none at all
  int found_images = 3;              ///< Least number of images compared with this pose
  double found_distance_m = 0.5;     ///< Least distance driven since the first of these images
  double found_explained = 0.5;      ///< Share of the directions in the last images that belong to mapped landmarks

  // Model of an image
  double detection_probability = 0.0;  ///< Probability that a landmark in view is detected; 0: by rig, else unknown
  double mapped_share = 0.5;           ///< Expected share of the directions that belong to mapped landmarks
  double changed_probability = 0.02;   ///< Probability that a mapped landmark has gone, or a lamp is not lit
  double gate_sigmas = 3.5;            ///< A direction that deviates by more does not belong to the landmark
  double key_distance_m = 0.15;        ///< Distance from the last used image at which an image is used
  double key_turn_rad = 0.15;          ///< Turn since the last used image at which an image is used

  // Effort
  int max_hypotheses = 48;     ///< Number of poses tracked
  int search_checks = 600000;  ///< Comparisons of directions with landmarks, per image, in the search for new poses
  int refined_poses = 24;      ///< Number of suggested poses per image that are refined
  int history_images = 6;      ///< Number of past images with which a new pose is compared
  int max_directions = 40;     ///< Directions used per image; further ones are left out
  int seed = 1;                ///< Seed of the sampling: the same seed gives the same poses

  friend bool operator==(const RelocalisationSettings&, const RelocalisationSettings&) = default;
};

}  // namespace azimuth
