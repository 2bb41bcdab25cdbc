#pragma once
// Every parameter of FastSLAM, with its section of docs/mathematics.md, unit and default. The presets hold the values
// printed in the paper.

#include <cstdint>

#include "slam/fastslam/lamps_in_view.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth {

enum class LampLikelihood : std::uint8_t {
  marginal,  ///< N(z; zbar, S), a density of the detection
  paper      ///< Density of the detection after it has moved the pose (equation of Algorithm 2)
};
enum class LampAssociationMethod : std::uint8_t { hungarian, nearest };
enum class LampCost : std::uint8_t {
  logarithm,   ///< The assignment with the largest joint likelihood
  probability  ///< The assignment with the largest sum of likelihoods, as printed
};
enum class ParticleWeight : std::uint8_t {
  /// One joint density of all detections of an image, plus a factor for each detection matched with no near landmark
  stacked,
  product  ///< As printed: a factor for each landmark of type I, with the residual at the sampled pose
};
enum class NewLampCovariance : std::uint8_t {
  geometric,  ///< A fit over all detections of the candidate, including the uncertainty of the poses between them
  fixed       ///< As printed
};

/// mathematics II.4, II.5.
struct LampAssociationSettings {
  LampLikelihood likelihood = LampLikelihood::marginal;
  LampAssociationMethod method = LampAssociationMethod::hungarian;
  LampCost cost = LampCost::logarithm;
  double gate_sigmas = 8.0;  ///< Gate: a detection that deviates more does not belong to the lamp
  /// Lower bound on the standard deviation of a detection. Crossings must agree with every detection of a candidate
  /// (mathematics II.8), from poses that a particle knows to some centimetres. This bound is the resulting angle for a
  /// lamp at 5 m.
  double sigma_floor_rad = 0.005;

  friend bool operator==(const LampAssociationSettings&, const LampAssociationSettings&) = default;
};

/// mathematics II.6, II.7.
struct ParticleWeightSettings {
  ParticleWeight method = ParticleWeight::stacked;
  /// Stacked: minus log of the factor of a detection of no landmark, relative to its peak density
  double unexplained_penalty = 9.0;
  double far_landmark_penalty = 2.0;  ///< Stacked: like unexplained_penalty, for a landmark of type II
  double resample_below_share = 0.5;  ///< Resampling when the effective share of particles is below this; 1: always

  friend bool operator==(const ParticleWeightSettings&, const ParticleWeightSettings&) = default;
};

/// When a candidate becomes a landmark (mathematics II.8).
struct LampCandidateSettings {
  double min_parallax_rad = 0.1222;  ///< Least angle between two rays whose crossing counts
  int min_sightings = 3;
  int min_cross_points = 5;     ///< Least number of valid crossings
  double height_m = 4.5;        ///< Initial guess of the height above the camera
  double height_sigma_m = 2.0;  ///< Standard deviation of height_m
  int most = 32;                ///< Greatest number of candidates of a particle

  friend bool operator==(const LampCandidateSettings&, const LampCandidateSettings&) = default;
};

/// Initial covariance of a landmark.
struct NewLampSettings {
  NewLampCovariance covariance = NewLampCovariance::geometric;
  double variance_m2 = 0.0025;  ///< For `fixed`: variance of each coordinate
  double sigma_floor_m = 0.01;  ///< For `geometric`: standard deviation added in quadrature to each coordinate

  friend bool operator==(const NewLampSettings&, const NewLampSettings&) = default;
};

struct FastSlamSettings {
  int particles = 10;
  int seed = 1;  ///< Seed of the random numbers

  // Detection
  LampsInView view;  ///< Without a limit in the rig, lamps are in view up to 90 degrees from the zenith
  LampAssociationSettings association;
  double key_distance_m = 0.05;  ///< Least path between images whose detections are kept for candidates and counted

  // Pose and weight
  bool relinearise = false;      ///< Linearises each landmark at the pose corrected by the previous landmarks
  double near_distance_m = 8.0;  ///< A landmark detected from nearer than this is of type I: used for pose and weight
  ParticleWeightSettings weight;

  // Life cycle of landmarks
  LampCandidateSettings candidates;
  NewLampSettings new_lamp;
  int max_counter = 20;          ///< Upper bound on a landmark's detections minus its misses
  bool refute_landmarks = true;  ///< Whether to delete landmarks that are more like chance reflections
  int max_landmarks = 256;       ///< Upper bound on the landmarks of a particle's map

  friend bool operator==(const FastSlamSettings&, const FastSlamSettings&) = default;
};

/// The settings that the FastSLAM paper prints ([G] in docs/mathematics.md). Two rays to a lamp must differ in
/// direction by at least 1.22 rad before their crossing counts (min_parallax_rad): only this value reproduces the
/// paper's results. The paper has no lower bound on a detection's noise, but this preset keeps sigma_floor_rad. Without
/// it the filter makes no map from rendered images, whose detections claim to be accurate to hundredths of a pixel.
inline FastSlamSettings paper_fastslam_preset() {
  FastSlamSettings settings;
  settings.association.likelihood = LampLikelihood::paper;
  settings.association.cost = LampCost::probability;
  settings.relinearise = true;
  settings.weight.method = ParticleWeight::product;
  settings.refute_landmarks = false;
  settings.weight.resample_below_share = 1.0;
  settings.candidates.min_parallax_rad = 1.22;
  settings.new_lamp.covariance = NewLampCovariance::fixed;
  settings.key_distance_m = 0.0;
  return settings;
}
/// The same settings, but the least difference in direction is 7 degrees, which the paper names too. With this value
/// the filter makes no usable map.
inline FastSlamSettings paper_7deg_fastslam_preset() {
  FastSlamSettings settings = paper_fastslam_preset();
  settings.candidates.min_parallax_rad = degrees_to_rad(7.0);
  return settings;
}

}  // namespace azimuth
