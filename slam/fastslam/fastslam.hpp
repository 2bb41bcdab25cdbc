#pragma once
// FastSLAM 2.0 with lamps (mathematics part II, algorithms 1 to 4): each particle is a path with a map of its own.

#include <cstdint>
#include <span>
#include <vector>

#include "slam/fastslam/error_covariance.hpp"
#include "slam/fastslam/fastslam_settings.hpp"
#include "slam/fastslam/lamp_associator.hpp"
#include "slam/fastslam/lamp_likelihood.hpp"
#include "slam/fastslam/lamp_recognition.hpp"
#include "slam/fastslam/lamp_update.hpp"
#include "slam/fastslam/particles.hpp"
#include "slam/geometry/motion.hpp"
#include "slam/geometry/random.hpp"
#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// Thread contract: thread-bound. Nothing allocates once the storage for the detections of one image has grown to the
/// largest. The same seed and calls give the same bits.
class FastSlam {
 public:
  static constexpr std::size_t kMostSightings = 64;  ///< Of one image; further detections are ignored

  /// `sigma_scales`: standard deviations of the odometer's scales, of distance and of turn.
  FastSlam(const FastSlamSettings& settings, const LampCamera& camera,
           const Eigen::Vector2d& sigma_scales = Eigen::Vector2d::Zero());

  /// Adds a motion of the robot. The covariance of `motion` must contain all its uncertainty.
  void predict(const Motion& motion);
  /// `lights` is the number of bright spots in the image, including those not among the detections.
  void update(std::span<const LampSighting> sightings, LampAssociator& associator, std::size_t lights = 0);

  // fastslam_saved_map.cpp
  /// Starts from a map of 3D points, at most as many as there is room for, and the pose in it.
  void restore(const MapSnapshot& map);
  /// Freezes the map.
  void hold_map() { holds_map_ = true; }
  /// Draws the particles about their current pose. `covariance` is in the body's frame.
  void disperse(const Eigen::Matrix3d& covariance);
  /// Moves all particles to another pose. `covariance` is in the body's frame.
  void place(const Pose2& T_map_body, const Eigen::Matrix3d& covariance);
  /// Writes the pose, the proven landmarks and their covariance; returns false if there is no proven landmark. Other
  /// members of `out` stay unchanged.
  bool save(MapSnapshot& out) const;

  const LampCamera& camera() const { return camera_; }
  const Particles& particles() const { return particles_; }
  std::size_t best() const { return best_; }  ///< The particle with the greatest weight
  /// The best particle's pose at the present instant.
  Pose2 pose() const { return particles_[best_].T_map_body * pending_.T_start_end; }
  /// The error covariance of the best particle's pose and map at the last update. The spread of the particles would
  /// underestimate it, since they soon descend from one particle.
  const ErrorCovariance& errors() const { return errors_; }
  const Motion& pending() const { return pending_; }  ///< Motion since the last update

  /// For each detection of the last update: the id of the landmark with which the best particle associated it, or
  /// kNoLamp.
  static constexpr std::int64_t kNoLamp = -1;
  std::span<const std::int64_t> lamps_of_sightings() const;
  /// Number of the best particle's landmarks that are proven to be lamps and not reflections.
  std::size_t proven() const;
  /// Whether the last image showed more of the proven landmarks than chance would.
  bool speaks_for_the_map() const { return particles_[best_].log_evidence > 0.0; }
  /// Landmark counts of the best particle since the start.
  const MapCounts& counts() const { return particles_[best_].counts; }

 private:
  void begin(std::span<const LampSighting> sightings, std::size_t lights);
  void step(std::size_t k, LampAssociator& associator);
  bool is_in_inner_view(const Viewpoint& from, const Eigen::Vector3d& p_map) const;
  void note_recognised(std::size_t k);
  void propose(ParticleStep& step);
  PoseProposal linear_proposal(const ParticleStep& step) const;
  void learn(ParticleStep& step);
  void weigh_evidence(const ParticleStep& step);
  void ask_which_are_near(const ParticleStep& step);
  void miss_landmarks(ParticleStep& step);
  void finish();
  void follow_proposal(const ParticleStep& step, const Symmetric3& proposal);
  void follow_pose();
  void follow_new(const LampCandidate& candidate, const Eigen::Vector3d& p_map);
  void follow_best();

  // fastslam_candidates.cpp
  void observe_candidates(ParticleStep& step, LampAssociator& associator);
  void pair_candidates(const ParticleStep& step);
  void begin_candidates(const ParticleStep& step);
  bool observe(ParticleStep& step, LampCandidate& candidate, std::size_t sighting);
  void keep_sighting(LampCandidate& candidate, std::size_t sighting) const;
  void collect_rays(const ParticleStep& step, LampCandidate& candidate);
  bool make_landmark(ParticleStep& step, const LampCandidate& candidate);
  void add_candidate(const ParticleStep& step, std::size_t sighting);
  CrossingRules rules() const;

  const LampSighting& sighting(const SightingIndex& index) const;

  FastSlamSettings settings_;
  LampCamera camera_;
  double cos_inner_zenith_;
  double log_miss_, log_detection_;
  RandomNumbers<Xoshiro> random_;
  Particles particles_;
  ErrorCovariance errors_;  // Of the best particle
  bool holds_map_ = false;
  Motion pending_;
  double since_key_m_ = 0.0;
  std::int64_t step_ = -1;  // Number of the newest kept step
  bool is_key_ = true;      // Whether the current step's detections are kept and counted
  std::int64_t sightings_so_far_ = 0;
  std::size_t best_ = 0;

  LampRecognition recognition_;     // Of the current particle
  std::vector<LampSighting> kept_;  // By step, modulo Particles::kPathSteps

  // Workspace of the current update.
  std::span<const LampSighting> seen_;
  std::vector<double> log_reflections_;           // Of each detection: Reflections::log_density()
  std::vector<std::int64_t> lamps_of_sightings_;  // Of all particles
  std::vector<double> log_weights_, weights_;
  std::vector<std::size_t> sources_;

  /// Workspace for the candidates of the current particle.
  struct CandidateWork {
    std::vector<ExpectedLamp> lamps;
    std::vector<LampPair> pairs;
    std::vector<int> target_of;  // Of each detection: index of a candidate
    std::vector<int> free;       // Detections matched with no landmark
    std::vector<Ray> rays;
    std::vector<Symmetric3> gathered;
  };
  CandidateWork candidate_work_;
};

}  // namespace azimuth
