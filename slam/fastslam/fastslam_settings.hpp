#pragma once
// Every parameter of FastSLAM: SPEC section, unit, and the default that measured best. The presets hold what the paper
// prints.

#include <cstdint>

#include "slam/fastslam/lamps_in_view.hpp"

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

/// SPEC II.4, II.5.
struct LampAssociationSettings {
  LampLikelihood likelihood = LampLikelihood::marginal;
  LampAssociationMethod method = LampAssociationMethod::hungarian;
  LampCost cost = LampCost::logarithm;
  double gate_sigmas = 8.0;  ///< a sighting this far off is of something new
  /// Standard deviation that a sighting has at least, whatever it claims: crossings must agree with every sighting of a
  /// candidate (SPEC II.8), from poses that a particle knows to some centimetres, and that is what a lamp at 5 m is
  /// off.
  double sigma_floor_rad = 0.005;

  friend bool operator==(const LampAssociationSettings&, const LampAssociationSettings&) = default;
};

/// SPEC II.6, II.7.
struct ParticleWeightSettings {
  ParticleWeight method = ParticleWeight::stacked;
  double unexplained_penalty = 9.0;   ///< stacked: minus log of a sighting of no landmark, relative to its peak
  double far_landmark_penalty = 2.0;  ///< stacked: likewise of a landmark of type II
  double resample_below_share = 0.5;  ///< when fewer particles than this are effective; 1: always

  friend bool operator==(const ParticleWeightSettings&, const ParticleWeightSettings&) = default;
};

/// What may become a landmark (SPEC II.8).
struct LampCandidateSettings {
  double min_parallax_rad = 0.1222;  ///< of two sightings whose crossing counts
  int min_sightings = 3;
  int min_cross_points = 5;     ///< valid ones
  double height_m = 4.5;        ///< first guess above the camera
  double height_sigma_m = 2.0;  ///< its standard deviation
  int most = 32;                ///< of a particle

  friend bool operator==(const LampCandidateSettings&, const LampCandidateSettings&) = default;
};

/// How well a landmark is known at first.
struct NewLampSettings {
  NewLampCovariance covariance = NewLampCovariance::geometric;
  double variance_m2 = 0.0025;  ///< fixed: of each coordinate
  double sigma_floor_m = 0.01;  ///< geometric: added in quadrature

  friend bool operator==(const NewLampSettings&, const NewLampSettings&) = default;
};

struct FastSlamSettings {
  int particles = 10;
  int seed = 1;  ///< of the random numbers

  // What is seen
  LampsInView view;  ///< where the rig is silent, up to a right angle from the zenith
  LampAssociationSettings association;
  double key_distance_m = 0.05;  ///< sightings from nearer than this to the last ones kept are not kept, nor counted

  // Pose and weight
  bool relinearise = false;      ///< each landmark's model at the pose the one before led to
  double near_distance_m = 8.0;  ///< type I: used for pose and weight, when seen from nearer than this
  ParticleWeightSettings weight;

  // How landmarks come and go
  LampCandidateSettings candidates;
  NewLampSettings new_lamp;
  int max_counter = 20;          ///< of a landmark's sightings less its misses
  bool refute_landmarks = true;  ///< those go that are more like what reflections look like by chance
  int max_landmarks = 256;       ///< the map of a particle grows no further

  friend bool operator==(const FastSlamSettings&, const FastSlamSettings&) = default;
};

/// As printed, with a parallax of 1.22 rad (SPEC II.8), but for the floor of a sighting's noise, which is ours: without
/// it lamps in rendered images, which claim hundredths of a pixel, make no map.
FastSlamSettings paper_fastslam_preset();
/// As printed, with the 7 degrees that the same sentence names. Measured to fail.
FastSlamSettings paper_7deg_fastslam_preset();

}  // namespace azimuth
