#pragma once
// FastSLAM 2.0 over lamps (SPEC part II, algorithms 1 to 4): each particle is a path with a map of its own.

#include <cstdint>
#include <span>
#include <vector>

#include "slam/fastslam/fastslam_settings.hpp"
#include "slam/fastslam/lamp_associator.hpp"
#include "slam/fastslam/lamp_likelihood.hpp"
#include "slam/fastslam/particles.hpp"
#include "slam/fastslam/pose_proposal.hpp"
#include "slam/geometry/motion.hpp"
#include "slam/geometry/random.hpp"

namespace azimuth {

/// What the filter has to know of the camera.
struct LampCamera {
  double height_m = 0.0;                ///< of its viewpoint
  double max_zenith_rad = kPi / 2.0;    ///< it sees up to here
  double detection_probability = 0.85;  ///< of a lamp in view
  bool identities = false;              ///< sightings carry names, and nothing is to be associated
};

/// Thread contract: thread-bound. Nothing allocates once the storage for the sightings of one image has grown to the
/// largest. Same seed and calls, same bits.
class FastSlam {
 public:
  static constexpr std::size_t kMostSightings = 64;  ///< of one image; further ones are not used

  FastSlam(const FastSlamSettings& settings, const LampCamera& camera);

  /// The robot moved; the covariance of `motion` holds all there is.
  void predict(const Motion& motion);
  /// `lights` is how many there were in the image, those included that are not among the sightings.
  void update(std::span<const LampSighting> sightings, LampAssociator& associator, std::size_t lights = 0);

  const LampCamera& camera() const { return camera_; }
  const Particles& particles() const { return particles_; }
  std::size_t best() const { return best_; }  ///< the particle of the greatest weight
  /// The best particle's pose at the present instant.
  Pose2 pose() const { return particles_[best_].T_map_body * pending_.T_start_end; }
  /// The particles' spread about it, and the motion's since the last update. Says little of the true error: ten
  /// particles soon descend from one.
  Eigen::Matrix3d pose_covariance() const;
  const Motion& pending() const { return pending_; }  ///< since the last update

  /// Of the last update: the landmark (by id) that the best particle took each sighting for; kNoLamp: none.
  static constexpr std::int64_t kNoLamp = -1;
  std::span<const std::int64_t> lamps_of_sightings() const;
  /// Landmarks of the best particle that are lamps beyond doubt, whatever reflections there are.
  std::size_t proven() const;
  /// Whether the last image held more of them than chance would have it.
  bool speaks_for_the_map() const { return particles_[best_].log_evidence > 0.0; }
  /// Landmarks of the best particle, since the start.
  const MapCounts& counts() const { return particles_[best_].counts; }

 private:
  /// What one particle's step works on.
  struct Step {
    std::size_t k;
    Viewpoint x_hat, x_t;
    Symmetric3 R;
  };

  void begin(std::span<const LampSighting> sightings, std::size_t lights);
  void step(std::size_t k, LampAssociator& associator);
  void recognise(const Step& step, LampAssociator& associator);
  void recognise_names(const Step& step);
  void expect_visible(const Step& step);
  void pair_landmarks(const Step& step);
  bool may_be_in_view(const Step& step, const Eigen::Vector3d& p_map, const Symmetric3& Sigma) const;
  bool is_in_inner_view(const Viewpoint& from, const Eigen::Vector3d& p_map) const;
  void associate(LampAssociator& associator, std::size_t targets);
  void order_by_certainty(std::size_t k);
  void propose(Step& step);
  PoseProposal linear_proposal(const Step& step) const;
  void learn(Step& step);
  void weigh_evidence(const Step& step);
  void miss_landmarks(Step& step);
  void finish();

  // fastslam_candidates.cpp
  void observe_candidates(Step& step, LampAssociator& associator);
  void pair_candidates(const Step& step);
  void begin_candidates(const Step& step);
  bool observe(Step& step, LampCandidate& candidate, std::size_t sighting);
  void keep_sighting(LampCandidate& candidate, std::size_t sighting) const;
  void collect_rays(const Step& step, LampCandidate& candidate);
  bool make_landmark(Step& step, const LampCandidate& candidate);
  void add_candidate(const Step& step, std::size_t sighting);
  CrossingRules rules() const;

  const LampSighting& sighting(const SightingIndex& index) const;

  FastSlamSettings settings_;
  LampCamera camera_;
  double cos_max_zenith_, cos_inner_zenith_;
  double log_miss_, log_detection_;
  RandomNumbers<Xoshiro> random_;
  Particles particles_;
  Motion pending_;
  double since_key_m_ = 0.0;
  std::int64_t step_ = -1;  // of the newest sightings kept
  bool is_key_ = true;      // the running step's sightings are kept and counted
  std::int64_t sightings_so_far_ = 0;
  std::size_t best_ = 0;

  std::vector<LampSighting> kept_;  // by step, modulo Particles::kPathSteps

  // Of the running update.
  std::span<const LampSighting> seen_;
  Reflections reflections_;
  std::vector<double> log_new_;
  std::vector<std::int64_t> lamps_of_sightings_;  // of all particles
  std::vector<double> log_weights_, weights_;
  std::vector<std::size_t> sources_;

  // Of the running particle.
  std::vector<ExpectedLamp> lamps_;
  std::vector<LampPair> pairs_;
  std::vector<int> target_of_;            // of each sighting: index into lamps_
  std::vector<double> likelihood_of_;     // of each sighting that has a target
  std::vector<std::size_t> order_;        // sightings of near landmarks, the most certain first
  std::vector<std::uint8_t> recognised_;  // by slot
  std::vector<int> free_;                 // sightings of no landmark
  std::vector<Ray> rays_;
  std::vector<Symmetric3> gathered_;
};

}  // namespace azimuth
