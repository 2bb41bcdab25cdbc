#include <numbers>

#include "settings/configuration_sections.hpp"

namespace azimuth {
namespace {

std::vector<Key> decision_keys(RelocalisationSettings& relocalisation) {
  return {
      {"doubt_log_odds", &relocalisation.doubt_log_odds,
       "Log of the odds of not being where it is thought, above which the map is left as it is.", from_to(0, 1000)},
      {"lost_log_odds", &relocalisation.lost_log_odds,
       "Log of the odds of not being where it is thought, above which the robot is looked for anywhere; 0: never.",
       from_to(0, 1000)},
      {"found_probability", &relocalisation.found_probability,
       "Probability of one pose, against all others and against none, above which the robot is found.",
       from_to(0.5, 0.9999999)},
      {"found_images", &relocalisation.found_images,
       "Images that the pose of a robot that is found must have explained.", from_to(1, 1000)},
      {"found_distance_m", &relocalisation.found_distance_m, "Driven while the robot is looked for, at least.",
       from_to(0, 1000)},
      {"found_explained", &relocalisation.found_explained,
       "Share of the directions in the last images that must be of mapped landmarks.", from_to(0, 1)},
  };
}

std::vector<Key> evidence_keys(RelocalisationSettings& relocalisation) {
  return {
      {"detection_probability", &relocalisation.detection_probability,
       "Chance that a landmark in view is seen; 0: by rig, and where that is silent what is not seen says nothing.",
       from_to(0, 0.999)},
      {"mapped_share", &relocalisation.mapped_share, "Share of the directions expected to be of mapped landmarks.",
       from_to(0.05, 0.95)},
      {"changed_probability", &relocalisation.changed_probability,
       "That a mapped landmark is not there any more, or a lamp not lit.", from_to(0, 0.999)},
      {"gate_sigmas", &relocalisation.gate_sigmas, "A direction farther off is not of the landmark.", above_to(0, 30)},
      {"key_distance_m", &relocalisation.key_distance_m, "Images nearer to the last one used say nothing new.",
       from_to(0, 100)},
      {"key_turn_rad", &relocalisation.key_turn_rad,
       "Images nearer to the last one used than key_distance_m are used all the same after a turn by this.",
       from_to(0, 2.0 * std::numbers::pi)},
  };
}

std::vector<Key> effort_keys(RelocalisationSettings& relocalisation) {
  return {
      {"max_hypotheses", &relocalisation.max_hypotheses, "Poses kept in mind.", from_to(2, 1000)},
      {"search_checks", &relocalisation.search_checks,
       "Directions compared with landmarks in search of new poses, per image.", from_to(1000, 1000000000)},
      {"refined_poses", &relocalisation.refined_poses, "Poses found in one image that are looked at closely.",
       from_to(1, 1000)},
      {"history_images", &relocalisation.history_images,
       "Images that a new pose has to explain as well as the old ones did.", from_to(1, 100)},
      {"max_directions", &relocalisation.max_directions, "Directions of an image that are used; more are left out.",
       from_to(3, 1000)},
      {"seed", &relocalisation.seed, "Seed of the sampling: the same seed, the same poses.", from_to(0, 2147483647)},
  };
}

}  // namespace

Section relocalisation_section(RelocalisationSettings& relocalisation) {
  return {"relocalisation", "How a robot that is lost is noticed, and looked for in its map.",
          joined({decision_keys(relocalisation), evidence_keys(relocalisation), effort_keys(relocalisation)})};
}

}  // namespace azimuth
