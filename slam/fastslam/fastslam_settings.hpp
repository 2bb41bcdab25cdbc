#pragma once
// Every parameter of FastSLAM: SPEC section, unit, and the default that measured best. The presets hold what the paper
// prints.

#include <cstdint>

namespace azimuth {

enum class LampLikelihood : std::uint8_t {
  marginal,  ///< N(z; zbar, S), a density of the sighting
  paper      ///< of the sighting after it has moved the pose (eq of Algorithm 2)
};
enum class LampAssociationMethod : std::uint8_t { hungarian, nearest };
enum class LampCost : std::uint8_t {
  logarithm,   ///< the assignment of the largest joint likelihood
  probability  ///< of the largest sum of likelihoods, as printed
};
enum class ParticleWeight : std::uint8_t {
  stacked,  ///< all sightings of an image in one density, and one factor for each sighting whatever became of it
  product   ///< as printed: a factor for each landmark of type I, with the residual at the sampled pose
};
enum class NewLampCovariance : std::uint8_t {
  geometric,  ///< a fit over all of the candidate's sightings, with the uncertainty of the poses between them
  fixed       ///< as printed
};

struct FastSlamSettings {
  int particles = 10;
  int seed = 1;  ///< of the random numbers

  // Association (SPEC II.4, II.5)
  LampLikelihood likelihood = LampLikelihood::marginal;
  LampAssociationMethod association = LampAssociationMethod::hungarian;
  LampCost cost = LampCost::logarithm;
  double gate_sigmas = 8.0;  ///< a sighting this far off is of something new
  /// Standard deviation that a sighting has at least, whatever it claims: crossings must agree with every sighting of a
  /// candidate (SPEC II.8), from poses that a particle knows to some centimetres, and that is what a lamp at 5 m is
  /// off.
  double sigma_floor_rad = 0.005;

  // Pose and weight (SPEC II.6, II.7)
  bool relinearise = false;  ///< each landmark's model at the pose the one before led to
  ParticleWeight weight = ParticleWeight::stacked;
  double unexplained_penalty = 9.0;    ///< stacked: minus log of a sighting of no landmark, relative to its peak
  double far_landmark_penalty = 2.0;   ///< stacked: likewise of a landmark of type II
  double detection_probability = 0.0;  ///< of a lamp in view, at most 0.95; 0: by rig, else 0.85
  double max_zenith_rad = 0.0;         ///< lamps are in view up to here; 0: by rig, else a right angle
  double inner_margin = 0.1;           ///< share of that angle at its rim in which nothing is missed
  int max_counter = 20;                ///< of a landmark's sightings less its misses
  bool refute_landmarks = true;        ///< those go that are more like what reflections look like by chance
  double resample_below_share = 0.5;   ///< when fewer particles than this are effective; 1: always

  // Candidates (SPEC II.8)
  double min_parallax_rad = 0.1222;  ///< of two sightings whose crossing counts
  int min_sightings = 3;
  int min_cross_points = 5;  ///< valid ones
  NewLampCovariance new_covariance = NewLampCovariance::geometric;
  double new_variance_m2 = 0.0025;        ///< fixed: of each coordinate
  double new_sigma_floor_m = 0.01;        ///< geometric: added in quadrature
  double near_distance_m = 8.0;           ///< type I: used for pose and weight, when seen from nearer than this
  double candidate_height_m = 4.5;        ///< first guess above the camera
  double candidate_height_sigma_m = 2.0;  ///< its standard deviation
  double key_distance_m = 0.05;  ///< sightings from nearer than this to the last ones kept are not kept, nor counted
  int max_landmarks = 256;       ///< the map of a particle grows no further
  int max_candidates = 32;       ///< of a particle

  friend bool operator==(const FastSlamSettings&, const FastSlamSettings&) = default;
};

/// As printed, with a parallax of 1.22 rad (SPEC II.8).
FastSlamSettings paper_fastslam_preset();
/// As printed, with the 7 degrees that the same sentence names. Measured to fail.
FastSlamSettings paper_7deg_fastslam_preset();

}  // namespace azimuth
