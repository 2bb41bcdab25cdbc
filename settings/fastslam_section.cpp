#include <numbers>

#include "settings/configuration_sections.hpp"

namespace azimuth {
namespace {

std::vector<Key> particle_keys(FastSlamSettings& fastslam) {
  return {
      everyday({"particles", &fastslam.particles, "Particles: paths of the robot with a map of their own.",
                from_to(1, 10000)}),
      {"seed", &fastslam.seed, "Seed of the random numbers: the same seed, the same estimates.",
       from_to(0, 2147483647)},
      choice<ParticleWeight>("weight", fastslam.weight.method,
                             {{"stacked", ParticleWeight::stacked}, {"product", ParticleWeight::product}},
                             "stacked: one density for all sightings of an image; product: as printed."),
      {"relinearise", &fastslam.relinearise, "Each landmark's model at the pose that the one before led to."},
      {"unexplained_penalty", &fastslam.weight.unexplained_penalty,
       "stacked: minus the log of a sighting of no landmark, relative to the density's peak.", from_to(0, 100)},
      {"far_landmark_penalty", &fastslam.weight.far_landmark_penalty,
       "stacked: likewise of a landmark only seen from afar, which moves no pose.", from_to(0, 100)},
      {"resample_below_share", &fastslam.weight.resample_below_share,
       "Resample when fewer particles than this are effective; 1: after every image.", from_to(0, 1)},
  };
}

std::vector<Key> association_keys(FastSlamSettings& fastslam) {
  return {
      choice<LampLikelihood>("likelihood", fastslam.association.likelihood,
                             {{"marginal", LampLikelihood::marginal}, {"paper", LampLikelihood::paper}},
                             "marginal: of a sighting before it moves the pose; paper: after it has."),
      choice<LampAssociationMethod>(
          "association", fastslam.association.method,
          {{"hungarian", LampAssociationMethod::hungarian}, {"nearest", LampAssociationMethod::nearest}},
          "hungarian: all sightings of an image together; nearest: each by itself."),
      choice<LampCost>("cost", fastslam.association.cost,
                       {{"logarithm", LampCost::logarithm}, {"probability", LampCost::probability}},
                       "hungarian: largest sum of log-likelihoods or, as printed, of likelihoods."),
      {"gate_sigmas", &fastslam.association.gate_sigmas, "A sighting this far from every landmark is of something new.",
       above_to(0, 30)},
      {"sigma_floor_rad", &fastslam.association.sigma_floor_rad,
       "Standard deviation a sighting has at least: no particle knows its path so well that finer ones could agree.",
       from_to(0, 1)},
  };
}

std::vector<Key> view_keys(FastSlamSettings& fastslam) {
  return {
      {"detection_probability", &fastslam.view.detection_probability,
       "Chance that a lamp in view is seen; 0: by rig, else 0.85.", from_to(0, 1)},
      {"max_zenith_rad", &fastslam.view.max_zenith_rad,
       "Lamps are in view up to here; 0: the rig's theta_max_rad, else a right angle.", from_to(0, std::numbers::pi)},
      {"inner_margin", &fastslam.view.inner_margin,
       "Share of the angle of view, at its rim, in which nothing counts as missed.", from_to(0, 1)},
      {"max_counter", &fastslam.max_counter, "Most that a landmark's sightings less its misses can come to.",
       from_to(1, 100000)},
      {"refute_landmarks", &fastslam.refute_landmarks,
       "Landmarks go that are seen no more often, and no better in place, than reflections are by chance."},
  };
}

std::vector<Key> candidate_keys(FastSlamSettings& fastslam) {
  return {
      {"min_parallax_rad", &fastslam.candidates.min_parallax_rad,
       "Angle between two sightings of a new landmark whose crossing counts.", from_to(0, std::numbers::pi)},
      {"min_sightings", &fastslam.candidates.min_sightings, "Sightings a new landmark needs.", from_to(2, 48)},
      {"min_cross_points", &fastslam.candidates.min_cross_points,
       "Crossings of sightings a new landmark needs, with which all its sightings agree.", from_to(1, 16)},
      choice<NewLampCovariance>(
          "new_covariance", fastslam.new_lamp.covariance,
          {{"geometric", NewLampCovariance::geometric}, {"fixed", NewLampCovariance::fixed}},
          "Covariance of a new landmark. geometric: from a fit over all its sightings; fixed: as printed."),
      {"new_variance_m2", &fastslam.new_lamp.variance_m2, "fixed: of each coordinate [m^2].", above_to(0, 100)},
      {"new_sigma_floor_m", &fastslam.new_lamp.sigma_floor_m, "geometric: added in quadrature.", above_to(0, 10)},
      {"near_distance_m", &fastslam.near_distance_m,
       "A landmark is used for the pose once it was seen from nearer than this.", above_to(0, 10000)},
      {"candidate_height_m", &fastslam.candidates.height_m, "First guess of a lamp's height above the camera.",
       above_to(0, 1000)},
      {"candidate_height_sigma_m", &fastslam.candidates.height_sigma_m,
       "Standard deviation of the first guess of a lamp's height.", above_to(0, 1000)},
      {"key_distance_m", &fastslam.key_distance_m,
       "Driven between images whose sightings are kept and counted; 0: every image's.", from_to(0, 100)},
      {"max_landmarks", &fastslam.max_landmarks, "A particle's map grows no further than this.", from_to(1, 10000)},
      {"max_candidates", &fastslam.candidates.most, "Landmarks a particle may be about to begin.", from_to(1, 1000)},
  };
}

std::vector<Key> preset_keys(FastSlamPreset& preset) {
  return {choice<FastSlamPreset>("preset", preset,
                                 {{"default", FastSlamPreset::recommended},
                                  {"paper", FastSlamPreset::paper},
                                  {"paper-7deg", FastSlamPreset::paper_7deg}},
                                 "Values of the keys not given here. paper: as printed, with a parallax of "
                                 "1.22 rad; paper-7deg: with 7 degrees.")};
}

}  // namespace

Section fastslam_section(FastSlamSettings& fastslam, FastSlamPreset& preset) {
  return {"fastslam", "FastSLAM over lamps on a ceiling, with estimator = \"fastslam\".",
          joined({preset_keys(preset), particle_keys(fastslam), association_keys(fastslam), view_keys(fastslam),
                  candidate_keys(fastslam)})};
}

FastSlamSettings fastslam_preset(FastSlamPreset preset) {
  switch (preset) {
    case FastSlamPreset::recommended:
      return {};
    case FastSlamPreset::paper:
      return paper_fastslam_preset();
    case FastSlamPreset::paper_7deg:
      return paper_7deg_fastslam_preset();
  }
  return {};
}

}  // namespace azimuth
