#include <numbers>

#include "settings/configuration_sections.hpp"

namespace azimuth {
namespace {

std::vector<Key> matching_keys(LampEkfSettings& lamp_ekf) {
  return {
      {"gate_chi2", &lamp_ekf.gates.chi2, "Gate on one direction's squared distance from a lamp, 2 degrees of freedom.",
       above_to(0, 1000)},
      {"joint_gate_probability", &lamp_ekf.gates.joint_probability,
       "Joint compatibility of an image: confidence of the chi-square test.", from_to(0.5, 0.9999)},
      {"new_density_per_sr", &lamp_ekf.gates.new_density_per_sr,
       "Directions of something unmapped, in each steradian of an image.", above_to(0, 1000)},
      {"rival_log_ratio", &lamp_ekf.gates.rival_log_ratio,
       "What joint hypotheses this near in log-likelihood explain differently is not used; 0: the best one always "
       "wins.",
       from_to(0, 100)},
      {"detection_probability", &lamp_ekf.view.detection_probability,
       "Chance that a lamp in view is seen, at most 0.95; 0: by rig, else 0.85.", from_to(0, 0.95)},
      everyday({"max_zenith_rad", &lamp_ekf.view.max_zenith_rad,
                "Directions are used up to here from the zenith; 0: the rig's theta_max_rad, at most 1.3.",
                from_to(0, 1.5)}),
      {"inner_margin", &lamp_ekf.view.inner_margin, "Share of that angle at its rim in which nothing counts as missed.",
       from_to(0, 1)},
  };
}

std::vector<Key> new_lamp_keys(LampEkfSettings& lamp_ekf) {
  return {
      everyday({"height_m", &lamp_ekf.height.guess_m, "First guess of a lamp's height above the camera.",
                above_to(0, 1000)}),
      everyday({"height_sigma_m", &lamp_ekf.height.sigma_m,
                "Two lamps in three hang less than this above or below that; counts as at most 0.95 of it.",
                above_to(0, 1000)}),
      {"min_height_m", &lamp_ekf.height.least_m, "Above the camera; what proves lower is no lamp.", above_to(0, 100)},
      {"confirm_after_sightings", &lamp_ekf.probation.confirm_after_sightings,
       "A lamp seen less often is on probation: not published.", from_to(1, 100000)},
      {"confirm_after_m", &lamp_ekf.probation.confirm_after_m,
       "A lamp is on probation until seen again after so much was driven.", from_to(0, 1000)},
      {"confirm_nonlinearity", &lamp_ekf.probation.confirm_nonlinearity,
       "A lamp is on probation until its height is known to this share.", above_to(0, 10)},
      {"probation_m", &lamp_ekf.probation.drop_after_m,
       "A lamp on probation is taken out when not seen again within this distance driven.", above_to(0, 10000)},
      {"promote_nonlinearity", &lamp_ekf.promote_nonlinearity,
       "Once its height is known to this share a lamp becomes a point in space.", above_to(0, 1)},
      {"max_landmarks", &lamp_ekf.max_landmarks, "The map grows no further than this.", from_to(1, 10000)},
      {"max_directions", &lamp_ekf.max_directions,
       "In an image with more directions only confirmed lamps are looked for, and no new ones are begun.",
       from_to(1, 10000)},
      {"max_on_probation", &lamp_ekf.probation.most, "No lamps are begun while so many are on probation.",
       from_to(1, 10000)},
  };
}

std::vector<Key> upkeep_keys(LampEkfSettings& lamp_ekf) {
  return {
      {"judge_every_m", &lamp_ekf.evidence.judge_every_m,
       "Driven between images that count as misses of the lamps they do not show.", from_to(0, 100)},
      {"forget_log_odds", &lamp_ekf.evidence.forget_log_odds,
       "A lamp is taken out when the log-odds of its being there fall below this.", from_to(-1000, 0)},
      {"most_log_odds", &lamp_ekf.evidence.most_log_odds, "No lamp counts as surer than this.", from_to(0, 1000)},
      {"merge_chi2", &lamp_ekf.merging.chi2,
       "Lamps nearer than this by their covariance (3 degrees of freedom) may be one; 0: never.", from_to(0, 1000)},
      {"merge_after_misses", &lamp_ekf.merging.after_misses,
       "They are merged when one was missed so often in a row while the other was seen.", from_to(1, 100000)},
      {"sigma_camera_centre_px", &lamp_ekf.centre.sigma_px,
       "The image's centre may be this far off along u and along v (standard deviation), and is estimated wherever "
       "bearings come from images; 0: it is exact.",
       from_to(0, 1000)},
      {"second_start_centre_px", &lamp_ekf.centre.second_start_px,
       "Begin the map anew, once, when the same images have told the centre to this standard deviation; 0: never.",
       from_to(0, 1000)},
      {"invariant_update", &lamp_ekf.invariant_update, "Heading corrections turn the whole map."},
      {"recover_after_images", &lamp_ekf.recover_after_images,
       "The pose is taken to be vaguer after so many images in a row that contradict the map; 0: never.",
       from_to(0, 100000)},
  };
}

}  // namespace

Section lamp_ekf_section(LampEkfSettings& lamp_ekf) {
  return {"lamp_ekf", "One EKF over lamps on a ceiling, with estimator = \"lamp_ekf\".",
          joined({matching_keys(lamp_ekf), new_lamp_keys(lamp_ekf), upkeep_keys(lamp_ekf)})};
}

}  // namespace azimuth
