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
  double max_viewing_distance_m = 15.0;  ///< Views from more than twice as far away are not searched (mathematics I.12)
  int max_views = 20000;                 ///< Limit for all identities together
  int views_per_identity = 6;
  double view_spacing_m = 0.5;   ///< If two views are from places nearer together than this, only the newer is kept
  int stable_sightings = 3;      ///< An identity seen less often is unstable
  double forget_after_m = 20.0;  ///< An unstable identity is forgotten after driving this far without seeing it
  bool keep_patterns = true;     ///< Store the neighbours of a feature as well

  friend bool operator==(const DescriptorStoreSettings&, const DescriptorStoreSettings&) = default;
};

/// The stored view most similar to a feature, and the most similar view among its rivals: views of other identities, or
/// of identities that cannot be in the feature's direction. Several similar views of one landmark do not make a match
/// ambiguous, so they are not rivals (mathematics I.12).
struct NearestTwo {
  struct View {
    std::int32_t squared_distance = std::numeric_limits<std::int32_t>::max();
    Identity identity = kUnknownIdentity;
    std::uint32_t slot = 0;  ///< Slot in the store
  };
  View nearest, rival;  ///< kUnknownIdentity: there is none

  void add(const View& view) {
    if (view.squared_distance < nearest.squared_distance) {
      if (view.identity != nearest.identity) rival = nearest;
      nearest = view;
    } else if (view.identity != nearest.identity && view.squared_distance < rival.squared_distance) {
      rival = view;
    }
  }
  /// Distance of `nearest` over that of `rival`; 0 without a rival, 1 when both are identical to the feature.
  double ratio() const;
};

/// The interval of directions in which a landmark can be seen from the present pose.
struct SightedWithin {
  Identity identity = kUnknownIdentity;
  double azimuth_rad = 0.0;     ///< Middle of the interval
  double half_width_rad = 0.0;  ///< Half the width of the interval
};

/// Descriptors of everything seen, by identity: a bounded number of views from different places for each identity, and
/// a bounded number in all. Identities seen rarely and long ago are forgotten.
///
/// Thread contract: thread-bound. Nothing allocates once storage has grown to `max_views`. The same calls give the same
/// results on every processor.
class DescriptorStore {
 public:
  explicit DescriptorStore(const DescriptorStoreSettings& settings);

  /// Finds the exact nearest view and rival of each query among the views taken within twice the viewing distance of
  /// `p_map_robot_m`, or among all views if `anywhere`. Of equally near views the one with the lower slot wins.
  void find(std::span<const Descriptor> queries, const Eigen::Vector2d& p_map_robot_m, std::vector<NearestTwo>& out,
            bool anywhere = false);
  /// Variant for queries that are seen at `azimuths_rad`: the nearest view belongs to an identity that can be seen at
  /// the azimuth of the query. `within`, sorted by identity, has an entry for each known identity. The rival is the
  /// nearest view of the identities that cannot be seen at this azimuth, since the distance of such a view shows how
  /// similar descriptors are by chance. If there are none, the rival is a view of another identity. There is no nearest
  /// view unless it is nearer than the rival (mathematics VI.37).
  void find_within(std::span<const Descriptor> queries, std::span<const double> azimuths_rad,
                   std::span<const SightedWithin> within, const Eigen::Vector2d& p_map_robot_m,
                   std::vector<NearestTwo>& out);

  /// Adds the descriptor of `identity`, seen from `p_map_robot_m` after `path_m` of driving (which never decreases).
  void see(Identity identity, const Descriptor& looks, const Pattern& pattern, const Eigen::Vector2d& p_map_robot_m,
           double path_m);

  /// Appends the views of `identity`, oldest first.
  void save(Identity identity, std::vector<MapView>& out) const;
  /// Restores saved views, without their features' neighbours. Their identities count as stable and as last seen at the
  /// start of the path. Views for which there is no room are left out.
  void restore(std::span<const MapView> views);

  void forget(Identity identity);
  /// Forgets all identities that are not in `known`, which must be sorted by identity.
  void forget_all_but(std::span<const SightedWithin> known);
  /// Forgets unstable identities not seen for long; to be called once per image.
  void forget_unstable(double path_m);

  std::size_t views() const { return views_; }
  std::size_t identities() const;
  int views_of(Identity identity) const;
  /// The neighbours of a view's feature; empty unless patterns are kept.
  const Pattern& pattern(std::uint32_t slot) const;

 private:
  static constexpr std::uint32_t kNoSlot = 0xffffffff;
  struct Known {
    Identity identity;
    std::uint32_t first = kNoSlot;  ///< First slot of the identity's list of views; kNoSlot: forgotten
    int views = 0, sightings = 0;
    double last_seen_m = 0.0;
  };
  struct Slot {
    Identity identity = kUnknownIdentity;
    std::uint32_t next = kNoSlot;  ///< Next view of the same identity, or next free slot
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
  std::vector<Pattern> patterns_;  // indexed by slot
  std::vector<Known> known_;       // sorted by identity
  std::uint32_t first_free_ = kNoSlot;
  std::size_t views_ = 0;

  // State of the running search.
  std::vector<DescriptorQuery> queries_;
  std::vector<std::uint32_t> selected_;  // indexed by block, one bit per lane
  std::vector<SightedWithin> within_;    // indexed by slot, for the selected views
  std::vector<NearestTwo::View> elsewhere_;
  NearLanes near_;
};

}  // namespace azimuth
