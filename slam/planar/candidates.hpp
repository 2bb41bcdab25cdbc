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

/// A landmark that is not in the state yet, with the bearings under which it was seen (mathematics I.1, I.2).
struct Candidate {
  struct Bearing {
    int clone;           ///< Slot of the clone of the pose at which it was taken; kHere: the robot's present pose
    double azimuth_rad;  ///< in the camera's frame
    double sigma_rad;    ///< Standard deviation of the azimuth
    double radius_px;    ///< see azimuth::Bearing
  };
  static constexpr int kHere = -1;
  static constexpr std::size_t kMaxBearings = 32;

  Identity identity = kUnknownIdentity;
  Kind kind = kAnyKind;
  std::uint64_t last_image = 0;  ///< The last image that shows the landmark
  std::uint64_t last_clone = 0;  ///< Number of clones made when the landmark was seen last
  std::array<Bearing, kMaxBearings> bearings{};
  std::size_t count = 0;

  std::span<const Bearing> seen() const { return {bearings.data(), count}; }
};

/// Delayed initialisation: stores the bearings of unmapped landmarks, with clones of the poses they were taken from,
/// until two of them intersect in a point that is well described by a Gaussian (mathematics I.2 steps 4 to 7, I.4, I.8,
/// I.9).
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
    std::uint64_t sightings;  ///< Number of bearings that made it, including the pair that intersects
    double relative_entropy;  ///< Result of the quality test for the pair
    double radius_px;         ///< Distance of the newest bearing from the image's centre
  };

  /// Processes the bearings of unmapped landmarks in the present image. Landmarks with a well-conditioned pair of
  /// bearings are added to the state and to created(), and their remaining bearings are applied. Clones that are no
  /// longer needed are dropped, and the present pose is cloned if it is needed.
  void observe(BearingEkf& ekf, std::span<const Bearing> unmapped);
  std::span<const Created> created() const { return created_; }

  std::span<const Candidate> candidates() const { return candidates_; }
  /// A clone of a past pose, kept for the bearings taken from it.
  struct Clone {
    Index block = 0;
    std::uint64_t image = 0;  ///< Number of the image, counting calls of observe() from 0
    int users = 0;            ///< Number of bearings taken from this pose; 0: the slot is free
  };
  std::span<const Clone> clones() const { return clones_; }
  std::uint64_t images() const { return image_; }

 private:
  struct Pair {
    std::size_t earlier;
    double relative_entropy;
    Intersection meeting;
    double sigma_rad;  ///< The larger of the standard deviations of the pair's bearings
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
  std::vector<Candidate> initialised_;  // landmarks added from the present image, with their remaining bearings
  std::vector<MappedSighting> remaining_;
};

}  // namespace azimuth
