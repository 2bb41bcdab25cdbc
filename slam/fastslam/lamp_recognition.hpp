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

/// What the filter has to know of the camera.
struct LampCamera {
  double height_m = 0.0;                ///< of its viewpoint
  double max_zenith_rad = kPi / 2.0;    ///< it sees up to here
  double detection_probability = 0.85;  ///< of a lamp in view
  bool identities = false;              ///< sightings carry names, and nothing is to be associated
};

/// What one particle's step works on.
struct ParticleStep {
  std::size_t k;         ///< of the particle
  Viewpoint x_hat, x_t;  ///< where the motion leads, by its mean; and the pose that was drawn
  Symmetric3 R;          ///< of the motion
};

/// Which sightings of an image are of which landmarks of a particle, as seen from where the motion leads it (SPEC II.4
/// and II.5).
///
/// Thread contract: thread-bound; does not allocate.
class LampRecognition {
 public:
  LampRecognition(const FastSlamSettings& settings, const LampCamera& camera, std::size_t most_sightings);

  /// The image all particles look at. It must live until the next one begins.
  void begin(std::span<const LampSighting> seen);
  /// Replaces what is asked below by what this particle recognises.
  void recognise(const Particles& particles, const ParticleStep& step, LampAssociator& associator);

  std::span<const LampSighting> seen() const { return seen_; }
  /// ln of how likely a sighting is of something new; what explains it less well is not considered.
  std::span<const double> log_new() const { return log_new_; }
  /// The landmark that a sighting is of, as it was expected; null: of none.
  const ExpectedLamp* lamp_of(std::size_t sighting) const {
    return target_of_[sighting] == kNoTarget ? nullptr : &lamps_[as_size(target_of_[sighting])];
  }
  /// z - h(x_hat) of a sighting that is of a landmark, and ln of how likely that is (log_likelihood_marginal()).
  const Eigen::Vector2d& innovation_of(std::size_t sighting) const { return of_landmark_[sighting].innovation; }
  double log_likelihood_of(std::size_t sighting) const { return of_landmark_[sighting].log_likelihood; }
  /// The landmarks that were expected in the image.
  std::span<const ExpectedLamp> lamps() const { return lamps_; }
  /// Whether the landmark in each slot was recognised.
  std::span<const std::uint8_t> recognised() const { return recognised_; }
  /// The sightings of near landmarks, the most certain landmark first.
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
  std::vector<int> target_of_;         // of each sighting: index into lamps_
  std::vector<double> likelihood_of_;  // of each sighting that has a target
  /// Of each sighting that has a target.
  struct OfLandmark {
    Eigen::Vector2d innovation = Eigen::Vector2d::Zero();
    double log_likelihood = 0.0;
  };
  std::vector<OfLandmark> of_landmark_;
  std::vector<std::size_t> last_slots_;  // of each sighting: in the particle before
  std::vector<std::size_t> order_;
  std::vector<std::uint8_t> recognised_;
};

}  // namespace azimuth
