#pragma once
#include <numbers>

namespace azimuth {

/// How a lost robot is looked for in a known map.
struct RelocalisationSettings {
  // When it counts as lost
  double doubt_log_odds = 2.0;  ///< of not being where it is thought, above which the map is left as it is
  double lost_log_odds = 10.0;  ///< and above which the robot is looked for anywhere; 0: never

  // When it counts as found
  double found_probability = 0.999;  ///< of one pose, against all others that were thought of and against none at all
  int found_images = 3;              ///< that this pose has explained
  double found_distance_m = 0.5;     ///< driven meanwhile
  double found_explained = 0.5;      ///< share of the directions in the last images that are of mapped landmarks

  // What an image says
  double detection_probability = 0.0;  ///< of a landmark in view; 0: by rig, and where that is silent, not known
  double mapped_share = 0.5;           ///< of the directions, expected to be of mapped landmarks
  double changed_probability = 0.02;   ///< that a mapped landmark is not there any more, or a lamp not lit
  double gate_sigmas = 3.5;            ///< a direction farther off is not of the landmark
  double key_distance_m = 0.15;        ///< images nearer to the last one used say nothing new
  double key_turn_rad = 0.15;          ///< unless the robot turned by this

  // Effort
  int max_hypotheses = 48;     ///< poses kept in mind
  int search_checks = 600000;  ///< directions compared with landmarks, per image, in search of new poses
  int refined_poses = 24;      ///< of those found in one image, that are looked at closely
  int history_images = 6;      ///< that a new pose has to explain as well as the old ones did
  int max_directions = 40;     ///< of an image; more are left out
  int seed = 1;                ///< of the sampling: the same seed, the same poses

  friend bool operator==(const RelocalisationSettings&, const RelocalisationSettings&) = default;
};

}  // namespace azimuth
