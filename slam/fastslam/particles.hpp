#pragma once
// Storage of the particles: flat arrays with fixed room for each particle, so that a step does not allocate and a copy
// moves only the part in use.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "slam/fastslam/cross_point.hpp"
#include "slam/fastslam/lamp_evidence.hpp"
#include "slam/fastslam/lamp_likelihood.hpp"
#include "slam/fastslam/symmetric.hpp"
#include "slam/geometry/index.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Small data of a landmark that every step needs, in addition to its position. Kept small because it is fetched from
/// memory for each particle.
struct LampInfo {
  /// Number of the landmark's first detection, which is equal in all particles that agree on the landmark
  std::int64_t id = 0;
  Identity identity = kUnknownIdentity;  ///< The sensor's identity for the landmark, if any
  int counter = 0;                       ///< Detections minus misses
  std::uint32_t sightings = 0;           ///< Number of detections that corrected the landmark
  LampEvidence evidence = {};            ///< Evidence that the landmark is a lamp
  bool near = false;                     ///< Type I: used for pose and weight
};

/// Counts the detections of a candidate minus a penalty for misses: each consecutive miss costs one more than the
/// previous.
struct CandidateCounter {
  int count = 1;
  int misses = 0;  ///< Consecutive misses
  void seen() {
    ++count;
    misses = 0;
  }
  /// Returns false if the candidate must be deleted.
  bool missed() {
    count -= ++misses;
    return count > 0;
  }
};

/// Index of a kept detection.
struct SightingIndex {
  std::int64_t step = 0;
  std::int32_t in_step = 0;
};

/// A detected object that is not yet a landmark. Trivially copyable.
struct LampCandidate {
  static constexpr std::size_t kMostSightings = 48;

  std::int64_t id = 0;
  Identity identity = kUnknownIdentity;
  CandidateCounter counter;
  Eigen::Vector3d p_map = Eigen::Vector3d::Zero();  ///< Mean of its Gaussian position, for data association
  Symmetric3 covariance;
  std::array<SightingIndex, kMostSightings> sightings;  ///< Oldest first
  std::size_t sighting_count = 0;
  CrossPoints points;
};

/// A particle's pose at a step whose detections are kept.
struct PathPoint {
  Viewpoint from;
  Symmetric3 gathered;  ///< Sum of the covariances of all its proposals up to this step
};

/// Numbers of landmarks created and deleted in the particle's line of descent.
struct MapCounts {
  std::uint64_t created = 0, deleted = 0;
};

struct Particle {
  Pose2 T_map_body;
  double log_weight = 0.0;
  Symmetric3 gathered;
  std::size_t landmarks = 0, candidates = 0;
  MapCounts counts;
  /// Log evidence of the last image for the proven landmarks; a negative value speaks against them
  double log_evidence = 0.0;
  /// Position at which all landmarks were last tested for nearness; nullopt if they never were.
  std::optional<Eigen::Vector2d> asked_from_m;
};

/// A set of slots of a particle's map: one bit for each, in words stored outside this class.
///
/// Thread contract: that of the words.
template <class Word = std::uint64_t>
class SlotSet {
 public:
  static constexpr std::size_t kSlotsOfWord = 64;
  static constexpr std::size_t words_for(std::size_t slots) { return (slots + kSlotsOfWord - 1) / kSlotsOfWord; }

  explicit SlotSet(std::span<Word> words) : words_(words) {}

  bool contains(std::size_t slot) const { return (words_[slot / kSlotsOfWord] & bit(slot)) != 0; }
  void insert(std::size_t slot) { words_[slot / kSlotsOfWord] |= bit(slot); }
  void erase(std::size_t slot) { words_[slot / kSlotsOfWord] &= ~bit(slot); }

  /// Calls `what(slot)` for each slot, from the last to the first. `what` may erase this slot and change later ones.
  template <class What>
  void for_each_from_last(What&& what) const {
    for (std::size_t w = words_.size(); w-- > 0;)
      for (std::uint64_t left = words_[w]; left != 0;) {
        const auto highest = kSlotsOfWord - 1 - static_cast<std::size_t>(std::countl_zero(left));
        left &= ~bit(highest);
        what(w * kSlotsOfWord + highest);
      }
  }

 private:
  static std::uint64_t bit(std::size_t slot) { return std::uint64_t{1} << (slot % kSlotsOfWord); }

  std::span<Word> words_;
};

/// Thread contract: thread-bound. Nothing allocates after construction.
class Particles {
 public:
  static constexpr std::int64_t kPathSteps = 512;  ///< Older poses and detections are dropped

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
  /// Covariance of each landmark's error relative to the pose from which it was mapped.
  std::span<const Symmetric3> mapped_with(std::size_t k) const { return map_of(mapped_with_, k); }
  /// The slots of a particle's landmarks that may be in the field of view near its position, including new landmarks.
  SlotSet<std::uint64_t> nearby(std::size_t k) {
    return SlotSet(std::span(nearby_.data() + k * words_of_map_, words_of_map_));
  }
  SlotSet<const std::uint64_t> nearby(std::size_t k) const {
    return SlotSet(std::span(nearby_.data() + k * words_of_map_, words_of_map_));
  }
  bool has_room_for_landmark(std::size_t k) const { return particles_[k].landmarks < max_landmarks_; }
  void add_landmark(std::size_t k, const Eigen::Vector3d& p_map, const Symmetric3& covariance, const LampInfo& info,
                    const Symmetric3& mapped_with = {});
  /// Removes a landmark; the last one moves to its slot.
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

  /// Replaces the particles by copies of those in `source` (ascending). Each surviving particle stays in place; only
  /// its further copies are made, in the places of lost particles. `step` is the newest step of the paths.
  void resample(std::span<const std::size_t> source, std::int64_t step);

  /// Prefetches the data of particle k, which is processed next at this step and may see the same lamps. With many
  /// particles the data are no longer in the caches, and waiting for them would take longer than the computation.
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
  std::vector<std::size_t> copies_;  // Workspace of resample()
};

/// Converts log-weights with an arbitrary offset to weights that sum to 1. Returns N_eff, the effective number of
/// particles.
double normalise(std::span<const double> log_weights, std::span<double> weights);

/// Low-variance resampling (mathematics II.9): writes for each new particle the index of the particle that it copies,
/// in ascending order. `start` is in [0, 1 / M), where M is the number of particles; the weights must sum to 1.
void low_variance(std::span<const double> weights, double start, std::span<std::size_t> source);

}  // namespace azimuth
