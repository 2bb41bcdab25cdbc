#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "slam/association/descriptor_block.hpp"
#include "slam/association/feature_patterns.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

struct DescriptorStoreSettings {
  double max_viewing_distance_m = 15.0;  ///< views taken farther away than twice this are not searched (SPEC I.12)
  int max_views = 20000;                 ///< of all identities together
  int views_per_identity = 6;
  double view_spacing_m = 0.5;   ///< of one identity's views nearer together than this only the newest is kept
  int stable_sightings = 3;      ///< an identity seen less often is unstable
  double forget_after_m = 20.0;  ///< driven since an unstable identity was last seen, until it is forgotten
  bool keep_patterns = true;     ///< store what surrounds a feature as well

  friend bool operator==(const DescriptorStoreSettings&, const DescriptorStoreSettings&) = default;
};

/// The stored view that looks most like a feature, and the one that does of all that the feature is not of: of other
/// identities, or of those that cannot be where it is seen. Several views of one landmark look alike; that does not
/// make a match doubtful (SPEC I.12).
struct NearestTwo {
  struct View {
    std::int32_t squared_distance = std::numeric_limits<std::int32_t>::max();
    Identity identity = kUnknownIdentity;
    std::uint32_t slot = 0;  ///< in the store
  };
  View nearest, rival;  ///< of kUnknownIdentity: there is none

  void add(const View& view) {
    if (view.squared_distance < nearest.squared_distance) {
      if (view.identity != nearest.identity) rival = nearest;
      nearest = view;
    } else if (view.identity != nearest.identity && view.squared_distance < rival.squared_distance) {
      rival = view;
    }
  }
  /// Distance of the nearest over that of the rival, 0 without a rival, 1 when both look exactly the same.
  double ratio() const;
};

/// All directions in which a landmark can be seen now.
struct SightedWithin {
  Identity identity = kUnknownIdentity;
  double azimuth_rad = 0.0;     ///< in the middle of them
  double half_width_rad = 0.0;  ///< to either side
};

/// Looks of everything seen, by identity: a bounded number of views from different places for each, and a bounded
/// number in all. What was seen rarely and long ago is forgotten.
///
/// Thread contract: thread-bound. Nothing allocates once storage has grown to `max_views`. Same calls, same results on
/// every processor.
class DescriptorStore {
 public:
  explicit DescriptorStore(const DescriptorStoreSettings& settings);

  /// For each query the two nearest views, exactly, among those acquired within twice the viewing distance of
  /// `p_map_robot_m`, or `anywhere`. At equal distance the lower slot goes first.
  void find(std::span<const Descriptor> queries, const Eigen::Vector2d& p_map_robot_m, std::vector<NearestTwo>& out,
            bool anywhere = false);
  /// Likewise for queries that are seen at `azimuths_rad`: the nearest view is of an identity that can be there.
  /// `within`, in the order of identities, has one for each that is known. The rival is the nearest of all that cannot,
  /// since how like to it that is tells how like a thing may be by chance; where nothing cannot, it is of another
  /// identity. Nothing is nearest that is no nearer than the rival (SPEC VI.37).
  void find_within(std::span<const Descriptor> queries, std::span<const double> azimuths_rad,
                   std::span<const SightedWithin> within, const Eigen::Vector2d& p_map_robot_m,
                   std::vector<NearestTwo>& out);

  /// `identity` was seen from `p_map_robot_m`, after `path_m` of driving (which never falls), and looked so.
  void see(Identity identity, const Descriptor& looks, const Pattern& pattern, const Eigen::Vector2d& p_map_robot_m,
           double path_m);

  /// Appends the views of `identity`, oldest first.
  void save(Identity identity, std::vector<MapView>& out) const;
  /// Takes over views as they were saved, without what surrounded their features, as those of stable identities last
  /// seen at the start of the path. What there is no room for is left out.
  void restore(std::span<const MapView> views);

  void forget(Identity identity);
  /// Forgets those that are not in `known`, which is in the order of identities.
  void forget_all_but(std::span<const SightedWithin> known);
  /// Forgets unstable identities not seen for long; to be called once for each image.
  void forget_unstable(double path_m);

  std::size_t views() const { return views_; }
  std::size_t identities() const;
  int views_of(Identity identity) const;
  /// Of a view's feature; empty unless patterns are kept.
  const Pattern& pattern(std::uint32_t slot) const;

 private:
  static constexpr std::uint32_t kNoSlot = 0xffffffff;
  struct Known {
    Identity identity;
    std::uint32_t first = kNoSlot;  ///< of its list of views; none: it is forgotten
    int views = 0, sightings = 0;
    double last_seen_m = 0.0;
  };
  struct Slot {
    Identity identity = kUnknownIdentity;
    std::uint32_t next = kNoSlot;  ///< view of the same identity, or free slot
    Eigen::Vector2d p_map_robot_m = Eigen::Vector2d::Zero();
  };
  Known& known(Identity identity);
  std::vector<Known>::const_iterator find_known(Identity identity) const;
  std::uint32_t slot_for_view(Known& known, const Eigen::Vector2d& p_map_robot_m);
  std::uint32_t new_slot();
  std::uint32_t add_slot(Known& known, const Eigen::Vector2d& p_map_robot_m);
  void forget(Known& known);
  void forget_least_worth();
  void select(const Eigen::Vector2d& p_map_robot_m, bool anywhere);
  void list_within(std::span<const SightedWithin> within);
  void search(std::span<const Descriptor> queries, std::span<const double> azimuths_rad, std::span<NearestTwo> out);
  void compare(std::size_t first_query, std::size_t block, std::span<const double> azimuths_rad,
               std::span<NearestTwo> out);

  DescriptorStoreSettings settings_;
  std::vector<DescriptorBlock> blocks_;
  std::vector<Slot> slots_;
  std::vector<Pattern> patterns_;  // by slot
  std::vector<Known> known_;       // in the order of identities
  std::uint32_t first_free_ = kNoSlot;
  std::size_t views_ = 0;

  // Of the running search.
  std::vector<DescriptorQuery> queries_;
  std::vector<std::uint32_t> selected_;  // by block, a bit for each lane
  std::vector<SightedWithin> within_;    // by slot, of those selected
  std::vector<NearestTwo::View> elsewhere_;
  NearLanes near_;
};

}  // namespace azimuth
