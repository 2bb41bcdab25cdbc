#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "slam/association/descriptor_store.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/planar/ekf_settings.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// The filter's belief of its landmarks, as plain values for assigning identities to features.
struct IdentityBeliefs {
  /// A landmark in the state and its expected azimuth; NaN: it cannot be seen from here.
  struct Mapped {
    Identity identity = kUnknownIdentity;
    double azimuth_rad = std::numeric_limits<double>::quiet_NaN();  ///< in the camera's frame
    /// Variance H P H^T of the azimuth, without a bearing's noise
    double variance_rad2 = std::numeric_limits<double>::quiet_NaN();
  };
  /// An earlier bearing of a landmark that is not in the state yet.
  struct Sighted {
    Identity identity;
    Eigen::Vector2d p_map_camera_m;  ///< The place from which the bearing was taken
    double direction_rad;            ///< Direction of the bearing in the map frame
    double variance_rad2;            ///< Noise of the bearing
    double variance_turn_rad2;       ///< Variance of the robot's change of heading since the bearing
  };

  Pose2 T_map_camera;            ///< Present pose of the camera
  bool anywhere = false;         ///< The pose is a guess: only descriptors decide
  std::vector<Mapped> mapped;    ///< Sorted by identity
  std::vector<Sighted> sighted;  ///< Sorted by identity
};

/// Assigns identities to features by their descriptors (mathematics I.12): decides which features of an image show
/// landmarks seen before, and which are new.
///
/// Thread contract: thread-bound. Nothing allocates once the store is full and no image is larger than any before. The
/// same calls give the same identities.
class FeatureIdentities {
 public:
  /// `sigma_bearing_rad` is used for bearings that carry no sigma of their own.
  FeatureIdentities(const IdentitySettings& settings, double sigma_bearing_rad, double max_viewing_distance_m);

  /// Returns the image with an identity for each bearing: that of a landmark seen before, or an unused one. Each
  /// identity occurs on one bearing only. The result is valid until the next call. Unless there is a descriptor for
  /// each bearing, all identities stay unknown.
  const BearingSet& name(const BearingSet& image, const IdentityBeliefs& beliefs);

  /// The filter rejected the bearing of this landmark in the image, so learn() must skip the descriptor of that
  /// bearing.
  void refuse(Identity identity);

  /// Learns the descriptors of the image, which was taken after `path_m` of driving.
  void learn(double path_m);

  const DescriptorStore& store() const { return store_; }

  /// No identity from this one on has been assigned.
  Identity next() const { return next_; }
  /// Starts with the descriptors of a saved map's landmarks; to be called before anything else.
  void restore(std::span<const MapView> views, Identity next);

  /// Outcome of the features so far.
  struct Counts {
    std::uint64_t mapped = 0;        ///< Recognised as a landmark in the map
    std::uint64_t sighted = 0;       ///< Recognised as a landmark that is not in the map yet
    std::uint64_t unlike = 0;        ///< New: matches no view, or two landmarks equally well
    std::uint64_t contradicted = 0;  ///< New: geometry or neighbouring features contradict the match
    std::uint64_t outdone = 0;       ///< New: another feature of the image matches the same landmark better
    std::uint64_t replaced = 0;      ///< New: the matching landmark has been given up
  };
  const Counts& counts() const { return counts_; }

 private:
  enum class Verdict { again, fresh };
  void look_up(const IdentityBeliefs& beliefs);
  void list_within(const IdentityBeliefs& beliefs);
  Verdict judge(std::size_t at, const IdentityBeliefs& beliefs);
  bool agrees_with_map(const Bearing& bearing, const IdentityBeliefs::Mapped& mapped) const;
  bool agrees_with_sightings(std::size_t at, std::span<const IdentityBeliefs::Sighted> sighted,
                             const IdentityBeliefs& beliefs) const;
  bool has_the_surroundings(std::size_t at) const;
  bool is_outdone(std::size_t at) const;
  double sigma_rad(const Bearing& bearing) const;
  double variance_rad2(const Bearing& bearing) const { return sigma_rad(bearing) * sigma_rad(bearing); }
  void spread_noise(double recognised);

  IdentitySettings settings_;
  double sigma_bearing_rad_;
  double max_viewing_distance_m_;
  DescriptorStore store_;
  Identity next_ = 0;
  Counts counts_;

  // State of the running image.
  BearingSet image_;
  Eigen::Vector2d p_map_camera_m_ = Eigen::Vector2d::Zero();
  std::vector<double> azimuths_rad_;
  std::vector<SightedWithin> within_;
  std::vector<NearestTwo> found_;
};

}  // namespace azimuth
