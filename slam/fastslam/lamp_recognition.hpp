#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/fastslam/fastslam_settings.hpp"
#include "slam/fastslam/lamp_associator.hpp"
#include "slam/fastslam/lamp_likelihood.hpp"
#include "slam/fastslam/particles.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {

/// The camera properties that the filter needs.
struct LampCamera {
  double height_m = 0.0;                ///< Height of the viewpoint
  double max_zenith_rad = kPi / 2.0;    ///< Limit of the field of view
  double detection_probability = 0.85;  ///< For a lamp in the field of view
  bool identities = false;              ///< Detections carry identities, so no data association is needed
};

/// The state of one particle's step.
struct ParticleStep {
  std::size_t k;         ///< Index of the particle
  Viewpoint x_hat, x_t;  ///< x_hat: the mean predicted by the motion; x_t: the drawn pose
  Symmetric3 R;          ///< Covariance of the motion
};

/// Associates the detections of an image with the landmarks of a particle, as seen from its predicted pose (mathematics
/// II.4 and II.5).
///
/// Thread contract: thread-bound; does not allocate.
class LampRecognition {
 public:
  LampRecognition(const FastSlamSettings& settings, const LampCamera& camera, std::size_t most_sightings);

  /// Sets the image for all particles. `seen` must stay valid until the next call.
  void begin(std::span<const LampSighting> seen);
  /// Computes the results below for one particle.
  void recognise(const Particles& particles, const ParticleStep& step, LampAssociator& associator);

  std::span<const LampSighting> seen() const { return seen_; }
  /// ln of the likelihood that a detection is of something new; less likely explanations are not considered.
  std::span<const double> log_new() const { return log_new_; }
  /// The predicted detection of the landmark with which a detection is associated; null if there is none.
  const ExpectedLamp* lamp_of(std::size_t sighting) const {
    return target_of_[sighting] == kNoTarget ? nullptr : &lamps_[as_size(target_of_[sighting])];
  }
  /// z - h(x_hat) of an associated detection, and ln of its likelihood (log_likelihood_marginal()).
  const Eigen::Vector2d& innovation_of(std::size_t sighting) const { return of_landmark_[sighting].innovation; }
  double log_likelihood_of(std::size_t sighting) const { return of_landmark_[sighting].log_likelihood; }
  /// The landmarks whose detection was predicted in the image.
  std::span<const ExpectedLamp> lamps() const { return lamps_; }
  /// Whether the landmark in each slot was recognised.
  std::span<const std::uint8_t> recognised() const { return recognised_; }
  /// The detections of near landmarks, ordered by falling certainty of the landmark.
  std::span<const std::size_t> by_certainty() const { return order_; }

 private:
  void recognise_names(const Particles& particles, const ParticleStep& step);
  std::size_t slot_of_name(std::span<const LampInfo> infos, std::size_t sighting);
  void expect_visible(const Particles& particles, const ParticleStep& step);
  void pair_landmarks(const Particles& particles, const ParticleStep& step);
  bool may_be_in_view(const ParticleStep& step, const Eigen::Vector3d& p_map, const Symmetric3& Sigma) const;
  void associate(LampAssociator& associator);
  void weigh(const Viewpoint& x_hat);
  void order_by_certainty(const Particles& particles, std::size_t k);

  LampAssociationSettings settings_;
  bool has_names_;
  double cos_max_zenith_;
  std::span<const LampSighting> seen_;
  std::vector<double> log_new_;
  std::vector<ExpectedLamp> lamps_;
  std::vector<LampPair> pairs_;
  std::vector<int> target_of_;         // Of each detection: index into lamps_
  std::vector<double> likelihood_of_;  // Of each associated detection
  /// Results for each associated detection.
  struct OfLandmark {
    Eigen::Vector2d innovation = Eigen::Vector2d::Zero();
    double log_likelihood = 0.0;
  };
  std::vector<OfLandmark> of_landmark_;
  std::vector<std::size_t> last_slots_;  // Of each detection: the landmark's slot in the previous particle
  std::vector<std::size_t> order_;
  std::vector<std::uint8_t> recognised_;
};

}  // namespace azimuth
