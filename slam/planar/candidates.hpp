#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "slam/camera/camera_rig.hpp"
#include "slam/ekf/bearing_ekf.hpp"
#include "slam/planar/ekf_settings.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// A landmark seen but not yet in the state, with the bearings it was seen under (SPEC I.1, I.2).
struct Candidate {
  struct Bearing {
    int clone;           ///< slot of the clone it was taken from; kHere: the robot's present pose
    double azimuth_rad;  ///< in the camera's frame
    double sigma_rad;    ///< its standard deviation
    double radius_px;    ///< see azimuth::Bearing
  };
  static constexpr int kHere = -1;
  static constexpr std::size_t kMaxBearings = 32;

  Identity identity = kUnknownIdentity;
  Kind kind = kAnyKind;
  std::uint64_t last_image = 0;  ///< in which it was seen
  std::uint64_t last_clone = 0;  ///< clones made by then
  std::array<Bearing, kMaxBearings> bearings{};
  std::size_t count = 0;

  std::span<const Bearing> seen() const { return {bearings.data(), count}; }
};

/// Delayed initialisation: keeps the bearings of unmapped landmarks together with clones of the poses they were taken
/// from, until two of them meet in a point that a Gaussian describes (SPEC I.2 steps 4 to 7, I.4, I.8, I.9).
///
/// Thread contract: thread-bound; the storage is bounded and does not grow with the run.
class Candidates {
 public:
  Candidates(const EkfSettings& settings, const CameraRig& rig);

  /// A landmark added to the state.
  struct Created {
    Identity identity;
    Kind kind;
    Index block;
    std::uint64_t sightings;  ///< bearings it was made from, those of the pair included
    double relative_entropy;  ///< of the pair
    double radius_px;         ///< of the newest bearing
  };

  /// The present image shows these unmapped landmarks. Adds to the state those with a well-conditioned pair, applies
  /// their remaining bearings, drops clones no longer needed and clones the present pose if it is. The landmarks
  /// added stand in created().
  void observe(BearingEkf& ekf, std::span<const Bearing> unmapped);
  std::span<const Created> created() const { return created_; }

  std::span<const Candidate> candidates() const { return candidates_; }
  /// A pose kept for its bearings.
  struct Clone {
    Index block = 0;
    std::uint64_t image = 0;  ///< counts calls of observe(), from 0
    int users = 0;            ///< bearings taken from it; 0: the slot is free
  };
  std::span<const Clone> clones() const { return clones_; }
  std::uint64_t images() const { return image_; }

 private:
  struct Pair {
    std::size_t earlier;
    double relative_entropy;
    Intersection meeting;
    double sigma_rad;  ///< of the less certain bearing
  };
  using SeenBearing = azimuth::Bearing;
  Candidate& candidate_for(const SeenBearing& bearing);
  void append(Candidate& candidate, const SeenBearing& bearing);
  void erase_bearing(Candidate& candidate, std::size_t at);
  void erase_candidate(std::size_t at);
  std::optional<Pair> find_pair(const BearingEkf& ekf, const Candidate& candidate) const;
  void initialise(BearingEkf& ekf, std::size_t at, const Pair& pair);
  void apply_remaining(BearingEkf& ekf, const Candidate& candidate, Index block);
  void expire(const BearingEkf& ekf);
  void drop_repeated(const BearingEkf& ekf);
  std::size_t free_slot(BearingEkf& ekf);
  void drop_unused_clones(BearingEkf& ekf);
  void clone_here(BearingEkf& ekf);

  EkfSettings settings_;
  CameraRig rig_;
  QualityTest quality_;
  std::uint64_t image_ = 0, clones_made_ = 0;
  std::vector<Candidate> candidates_;
  std::vector<Clone> clones_;
  std::vector<Created> created_;
  std::vector<Candidate> initialised_;  // of the running image, with their remaining bearings
  std::vector<MappedSighting> remaining_;
};

}  // namespace azimuth
