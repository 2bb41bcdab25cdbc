#pragma once
// The particles' storage: everything of all of them in a few flat arrays with a fixed room for each, so that a step
// allocates nothing and a copy moves only what is in use.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "slam/fastslam/cross_point.hpp"
#include "slam/fastslam/lamp_evidence.hpp"
#include "slam/fastslam/lamp_likelihood.hpp"
#include "slam/fastslam/slot_set.hpp"
#include "slam/fastslam/symmetric.hpp"
#include "slam/geometry/index.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// What every step asks of a landmark beside its place; small, as it is fetched anew for each particle.
struct LampInfo {
  std::int64_t id = 0;                   ///< the number of its first sighting: alike in particles that agree on it
  Identity identity = kUnknownIdentity;  ///< the sensor's name for it, if any
  int counter = 0;                       ///< sightings less misses
  std::uint32_t sightings = 0;           ///< that corrected it
  LampEvidence evidence = {};            ///< for it to be a lamp at all
  bool near = false;                     ///< type I: used for pose and weight
};

/// Sightings of a candidate less what its misses cost: each one in a row costs one more than the one before.
struct CandidateCounter {
  int count = 1;
  int misses = 0;  ///< in a row
  void seen() {
    ++count;
    misses = 0;
  }
  /// False: the candidate is to be deleted.
  bool missed() {
    count -= ++misses;
    return count > 0;
  }
};

/// Which sighting, of those kept.
struct SightingIndex {
  std::int64_t step = 0;
  std::int32_t in_step = 0;
};

/// Something seen that is no landmark yet. Trivially copyable.
struct LampCandidate {
  static constexpr std::size_t kMostSightings = 48;

  std::int64_t id = 0;
  Identity identity = kUnknownIdentity;
  CandidateCounter counter;
  Eigen::Vector3d p_map = Eigen::Vector3d::Zero();  ///< its Gaussian point, for association
  Symmetric3 covariance;
  std::array<SightingIndex, kMostSightings> sightings;  ///< oldest first
  std::size_t sighting_count = 0;
  CrossPoints points;
};

/// Where a particle was at a step whose sightings are kept.
struct PathPoint {
  Viewpoint from;
  Symmetric3 gathered;  ///< covariance of all its proposals until then, summed
};

/// What became of a particle's landmarks since its line of descent began.
struct MapCounts {
  std::uint64_t created = 0, deleted = 0;
};

struct Particle {
  Pose2 T_map_body;
  double log_weight = 0.0;
  Symmetric3 gathered;
  std::size_t landmarks = 0, candidates = 0;
  MapCounts counts;
  double log_evidence = 0.0;  ///< of the last image, for the landmarks that are lamps: less than 0 speaks against them
  /// Where it was when all of its landmarks were last asked which are near; none: never.
  std::optional<Eigen::Vector2d> asked_from_m;
};

/// Thread contract: thread-bound. Nothing allocates after construction.
class Particles {
 public:
  static constexpr std::int64_t kPathSteps = 512;  ///< older poses and sightings are forgotten

  Particles(std::size_t count, std::size_t max_landmarks, std::size_t max_candidates);

  std::size_t size() const { return particles_.size(); }
  Particle& operator[](std::size_t k) { return particles_[k]; }
  const Particle& operator[](std::size_t k) const { return particles_[k]; }

  // A particle's map, by slot.
  std::span<Eigen::Vector3d> positions(std::size_t k) { return map_of(positions_, k); }
  std::span<const Eigen::Vector3d> positions(std::size_t k) const { return map_of(positions_, k); }
  std::span<Symmetric3> covariances(std::size_t k) { return map_of(covariances_, k); }
  std::span<const Symmetric3> covariances(std::size_t k) const { return map_of(covariances_, k); }
  std::span<LampInfo> infos(std::size_t k) { return map_of(infos_, k); }
  std::span<const LampInfo> infos(std::size_t k) const { return map_of(infos_, k); }
  /// The covariance of each landmark's error as seen from the pose it was mapped from.
  std::span<const Symmetric3> mapped_with(std::size_t k) const { return map_of(mapped_with_, k); }
  /// Those of a particle's landmarks, by slot, that its whereabouts may bring into view; new ones are among them.
  SlotSet<std::uint64_t> nearby(std::size_t k) {
    return SlotSet(std::span(nearby_.data() + k * words_of_map_, words_of_map_));
  }
  SlotSet<const std::uint64_t> nearby(std::size_t k) const {
    return SlotSet(std::span(nearby_.data() + k * words_of_map_, words_of_map_));
  }
  bool has_room_for_landmark(std::size_t k) const { return particles_[k].landmarks < max_landmarks_; }
  void add_landmark(std::size_t k, const Eigen::Vector3d& p_map, const Symmetric3& covariance, const LampInfo& info,
                    const Symmetric3& mapped_with = {});
  /// The last one takes its slot.
  void remove_landmark(std::size_t k, std::size_t slot);

  std::span<LampCandidate> candidates(std::size_t k) {
    return {candidates_.data() + k * max_candidates_, particles_[k].candidates};
  }
  std::span<const LampCandidate> candidates(std::size_t k) const {
    return {candidates_.data() + k * max_candidates_, particles_[k].candidates};
  }
  std::size_t room_for_candidates(std::size_t k) const { return max_candidates_ - particles_[k].candidates; }
  bool has_room_for_candidate(std::size_t k) const { return room_for_candidates(k) > 0; }
  LampCandidate& add_candidate(std::size_t k);
  void remove_candidate(std::size_t k, std::size_t slot);

  PathPoint& path(std::size_t k, std::int64_t step) { return path_[path_index(k, step)]; }
  const PathPoint& path(std::size_t k, std::int64_t step) const { return path_[path_index(k, step)]; }

  /// Replaces the particles by copies of those in `source` (ascending). Every one that survives stays where it is; only
  /// further copies are made, in the place of the lost. `step` is the newest step of the paths.
  void resample(std::span<const std::size_t> source, std::int64_t step);

  /// Particle k is next, at this step, and may see the same lamps: where there are many particles, nothing of it is
  /// near the processor any more, and waiting for it would take longer than all that is computed.
  void fetch_ahead(std::size_t k, std::int64_t step, std::span<const ExpectedLamp> lamps) const;

 private:
  template <class T>
  std::span<T> map_of(std::vector<T>& all, std::size_t k) {
    return std::span<T>(all.data() + k * max_landmarks_, particles_[k].landmarks);
  }
  template <class T>
  std::span<const T> map_of(const std::vector<T>& all, std::size_t k) const {
    return std::span<const T>(all.data() + k * max_landmarks_, particles_[k].landmarks);
  }
  std::size_t path_index(std::size_t k, std::int64_t step) const {
    return k * as_size(kPathSteps) + as_size(step % kPathSteps);
  }
  void copy(std::size_t from, std::size_t to, std::int64_t step);

  std::size_t max_landmarks_, max_candidates_, words_of_map_;
  std::vector<Particle> particles_;
  std::vector<Eigen::Vector3d> positions_;
  std::vector<Symmetric3> covariances_;
  std::vector<LampInfo> infos_;
  std::vector<Symmetric3> mapped_with_;
  std::vector<std::uint64_t> nearby_;
  std::vector<LampCandidate> candidates_;
  std::vector<PathPoint> path_;
  std::vector<std::size_t> copies_;  // of the running resampling
};

}  // namespace azimuth
