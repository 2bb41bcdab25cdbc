#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "slam/association/descriptor_store.hpp"
#include "slam/planar/identity_beliefs.hpp"
#include "slam/planar/identity_settings.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Names for features that are known by their looks alone (SPEC I.12): which of an image's features is which landmark
/// seen before, and which is new.
///
/// Thread contract: thread-bound. Nothing allocates once the store is full and no image is larger than before. Same
/// calls, same names.
class FeatureIdentities {
 public:
  /// `sigma_bearing_rad` is that of bearings that do not say their own.
  FeatureIdentities(const IdentitySettings& settings, double sigma_bearing_rad, double max_viewing_distance_m);

  /// The image with an identity for each bearing: that of a landmark seen before, or one never given before. A name
  /// stands on one bearing only. Valid until the next call. Without a descriptor for each bearing all stay unknown.
  const BearingSet& name(const BearingSet& image, const IdentityBeliefs& beliefs);

  /// The filter did not believe that the image shows this landmark: its looks there are not to be learnt.
  void refuse(Identity identity);

  /// Learns the looks of what the image shows, taken after `path_m` of driving.
  void learn(double path_m);

  const DescriptorStore& store() const { return store_; }

  /// Names of this one and above have never been given.
  Identity next() const { return next_; }
  /// Begins with what another map's landmarks looked like; to be called before anything else.
  void restore(std::span<const MapView> views, Identity next);

  /// What became of the features so far.
  struct Counts {
    std::uint64_t mapped = 0;        ///< recognised as a landmark in the map
    std::uint64_t sighted = 0;       ///< as one that is not in it yet
    std::uint64_t unlike = 0;        ///< new: unlike anything, or like two things
    std::uint64_t contradicted = 0;  ///< new: geometry or surroundings spoke against what it looks like
    std::uint64_t outdone = 0;       ///< new: another feature looks more like it
    std::uint64_t replaced = 0;      ///< new: what it looks like had been given up
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

  // Of the running image.
  BearingSet image_;
  Eigen::Vector2d p_map_camera_m_ = Eigen::Vector2d::Zero();
  std::vector<double> azimuths_rad_;
  std::vector<SightedWithin> within_;
  std::vector<NearestTwo> found_;
};

}  // namespace azimuth
