#include "slam/association/descriptor_store.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "slam/geometry/angle.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

// Number of blocks that stay in the first-level cache while all queries are compared with them.
constexpr std::size_t kBlocksAtOnce = 8;

/// The entry of `identity`, or null. `in_order` is sorted by identity; entries before it are dropped, so calls must be
/// in ascending order.
const SightedWithin* next_with(Identity identity, std::span<const SightedWithin>& in_order) {
  while (!in_order.empty() && in_order.front().identity < identity) in_order = in_order.subspan(1);
  return !in_order.empty() && in_order.front().identity == identity ? &in_order.front() : nullptr;
}

}  // namespace

double NearestTwo::ratio() const {
  if (rival.identity == kUnknownIdentity) return 0.0;
  if (rival.squared_distance == 0) return 1.0;
  return std::sqrt(static_cast<double>(nearest.squared_distance) / static_cast<double>(rival.squared_distance));
}

DescriptorStore::DescriptorStore(const DescriptorStoreSettings& settings) : settings_(settings) {}

void DescriptorStore::find(std::span<const Descriptor> queries, const Eigen::Vector2d& p_map_robot_m,
                           std::vector<NearestTwo>& out, bool anywhere) {
  out.assign(queries.size(), {});
  select(p_map_robot_m, anywhere);
  search(queries, {}, out);
}

void DescriptorStore::find_within(std::span<const Descriptor> queries, std::span<const double> azimuths_rad,
                                  std::span<const SightedWithin> within, const Eigen::Vector2d& p_map_robot_m,
                                  std::vector<NearestTwo>& out) {
  out.assign(queries.size(), {});
  elsewhere_.assign(queries.size(), {});
  select(p_map_robot_m, false);
  list_within(within);
  search(queries, azimuths_rad, out);
  for (std::size_t query = 0; query < queries.size(); ++query) {
    NearestTwo& two = out[query];
    if (elsewhere_[query].identity != kUnknownIdentity) two.rival = elsewhere_[query];
    if (two.nearest.squared_distance >= two.rival.squared_distance) two.nearest = {};
  }
}

void DescriptorStore::search(std::span<const Descriptor> queries, std::span<const double> azimuths_rad,
                             std::span<NearestTwo> out) {
  queries_.clear();
  for (const Descriptor& descriptor : queries) queries_.emplace_back(descriptor);
  while (queries_.size() % kQueriesAtOnce != 0) queries_.emplace_back();  // padding; no view is below a bound of 0
  for (std::size_t first = 0; first < blocks_.size(); first += kBlocksAtOnce)
    for (std::size_t query = 0; query < queries.size(); query += kQueriesAtOnce)
      for (std::size_t block = first; block < std::min(first + kBlocksAtOnce, blocks_.size()); ++block)
        if (selected_[block] != 0) compare(query, block, azimuths_rad, out);
}

/// Selects the views taken near enough to be of a landmark in view.
void DescriptorStore::select(const Eigen::Vector2d& p_map_robot_m, bool anywhere) {
  const double limit2 = 4.0 * settings_.max_viewing_distance_m * settings_.max_viewing_distance_m;
  selected_.assign(blocks_.size(), 0);
  for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
    const bool near = anywhere || (slots_[slot].p_map_robot_m - p_map_robot_m).squaredNorm() < limit2;
    const bool selected = near && slots_[slot].identity != kUnknownIdentity;
    selected_[slot / DescriptorBlock::kLanes] |= (selected ? 1U : 0U) << slot % DescriptorBlock::kLanes;
  }
}

void DescriptorStore::list_within(std::span<const SightedWithin> within) {
  within_.resize(slots_.size());
  for (const Known& known : known_) {
    const SightedWithin* expected = next_with(known.identity, within);
    for (std::uint32_t slot = known.first; slot != kNoSlot; slot = slots_[slot].next)
      within_[slot] = expected != nullptr ? *expected : SightedWithin{};
  }
}

/// Compares one block with a group of queries. The rival's distance is the bound, since views as far away change
/// nothing.
void DescriptorStore::compare(std::size_t first_query, std::size_t block, std::span<const double> azimuths_rad,
                              std::span<NearestTwo> out) {
  const bool by_place = !azimuths_rad.empty();
  const std::size_t queries = std::min(kQueriesAtOnce, out.size() - first_query);
  std::array<std::int32_t, kQueriesAtOnce> bounds{};
  for (std::size_t q = 0; q < queries; ++q)
    bounds[q] = (by_place ? elsewhere_[first_query + q] : out[first_query + q].rival).squared_distance;
  find_near(blocks_[block], &queries_[first_query], bounds.data(), near_);
  for (std::size_t q = 0; q < queries; ++q)
    for (std::uint32_t lanes = near_.near[q] & selected_[block]; lanes != 0; lanes &= lanes - 1) {
      const auto lane = as_size(std::countr_zero(lanes));
      const std::size_t slot = block * DescriptorBlock::kLanes + lane, query = first_query + q;
      const NearestTwo::View view{near_.squared_distance[q][lane], slots_[slot].identity,
                                  static_cast<std::uint32_t>(slot)};
      if (!by_place || std::abs(wrap(azimuths_rad[query] - within_[slot].azimuth_rad)) <= within_[slot].half_width_rad)
        out[query].add(view);
      else if (view.squared_distance < elsewhere_[query].squared_distance)
        elsewhere_[query] = view;
    }
}

void DescriptorStore::see(Identity identity, const Descriptor& looks, const Pattern& pattern,
                          const Eigen::Vector2d& p_map_robot_m, double path_m) {
  if (views_ >= as_size(settings_.max_views) && views_of(identity) == 0) forget_least_worth();
  Known& entry = known(identity);
  ++entry.sightings;
  entry.last_seen_m = path_m;
  const std::uint32_t slot = slot_for_view(entry, p_map_robot_m);
  slots_[slot].p_map_robot_m = p_map_robot_m;
  blocks_[slot / DescriptorBlock::kLanes].set(slot % DescriptorBlock::kLanes, looks);
  if (settings_.keep_patterns) patterns_[slot] = pattern;
}

/// The slot of the view from the nearest place if that place is too near for a view of its own, or if there is no room
/// for another view; else a new slot.
std::uint32_t DescriptorStore::slot_for_view(Known& known, const Eigen::Vector2d& p_map_robot_m) {
  std::uint32_t nearest = kNoSlot;
  double nearest2 = std::numeric_limits<double>::infinity();
  for (std::uint32_t slot = known.first; slot != kNoSlot; slot = slots_[slot].next) {
    const double distance2 = (slots_[slot].p_map_robot_m - p_map_robot_m).squaredNorm();
    if (!(distance2 < nearest2)) continue;
    nearest2 = distance2;
    nearest = slot;
  }
  const bool full = known.views >= settings_.views_per_identity || views_ >= as_size(settings_.max_views);
  const bool repeats = nearest2 < settings_.view_spacing_m * settings_.view_spacing_m;
  if (nearest != kNoSlot && (full || repeats)) return nearest;
  return add_slot(known, p_map_robot_m);
}

std::uint32_t DescriptorStore::add_slot(Known& known, const Eigen::Vector2d& p_map_robot_m) {
  const std::uint32_t slot = new_slot();
  slots_[slot] = {known.identity, known.first, p_map_robot_m};
  known.first = slot;
  ++known.views;
  return slot;
}

std::uint32_t DescriptorStore::new_slot() {
  if (first_free_ == kNoSlot) {
    const std::size_t first = slots_.size();
    blocks_.emplace_back();
    slots_.resize(first + DescriptorBlock::kLanes);
    if (settings_.keep_patterns) patterns_.resize(first + DescriptorBlock::kLanes);
    for (std::size_t lane = DescriptorBlock::kLanes; lane-- > 0;) {
      slots_[first + lane].next = first_free_;
      first_free_ = static_cast<std::uint32_t>(first + lane);
    }
  }
  const std::uint32_t slot = first_free_;
  first_free_ = slots_[slot].next;
  ++views_;
  return slot;
}

std::vector<DescriptorStore::Known>::const_iterator DescriptorStore::find_known(Identity identity) const {
  return std::ranges::lower_bound(known_, identity, std::less{}, &Known::identity);
}

DescriptorStore::Known& DescriptorStore::known(Identity identity) {
  const auto at = known_.begin() + (find_known(identity) - known_.cbegin());
  if (at != known_.end() && at->identity == identity) return *at;
  return *known_.insert(at, Known{identity});
}

int DescriptorStore::views_of(Identity identity) const {
  const auto at = find_known(identity);
  return at != known_.end() && at->identity == identity ? at->views : 0;
}

std::size_t DescriptorStore::identities() const {
  return as_size(std::ranges::count_if(known_, [](const Known& k) { return k.views > 0; }));
}

void DescriptorStore::save(Identity identity, std::vector<MapView>& out) const {
  const auto at = find_known(identity);
  if (at == known_.end() || at->identity != identity) return;
  const auto first = static_cast<std::ptrdiff_t>(out.size());
  for (std::uint32_t slot = at->first; slot != kNoSlot; slot = slots_[slot].next)
    out.push_back({identity, slots_[slot].p_map_robot_m,
                   blocks_[slot / DescriptorBlock::kLanes].get(slot % DescriptorBlock::kLanes)});
  std::reverse(out.begin() + first, out.end());  // lists start with the newest
}

void DescriptorStore::restore(std::span<const MapView> views) {
  for (const MapView& view : views) {
    if (views_ >= as_size(settings_.max_views)) return;
    Known& entry = known(view.identity);
    if (entry.views >= settings_.views_per_identity) continue;
    entry.sightings = std::max(settings_.stable_sightings, entry.sightings + 1);
    const std::uint32_t slot = add_slot(entry, view.p_map_robot_m);
    blocks_[slot / DescriptorBlock::kLanes].set(slot % DescriptorBlock::kLanes, view.looks);
    if (settings_.keep_patterns) patterns_[slot] = Pattern{};
  }
}

void DescriptorStore::forget(Identity identity) {
  const auto at = known_.begin() + (find_known(identity) - known_.cbegin());
  if (at != known_.end() && at->identity == identity) forget(*at);
}

void DescriptorStore::forget_all_but(std::span<const SightedWithin> known) {
  for (Known& each : known_)
    if (next_with(each.identity, known) == nullptr) forget(each);
}

void DescriptorStore::forget(Known& known) {
  for (std::uint32_t slot = known.first; slot != kNoSlot;) {
    const std::uint32_t next = slots_[slot].next;
    slots_[slot] = {kUnknownIdentity, first_free_, Eigen::Vector2d::Zero()};
    first_free_ = slot;
    --views_;
    slot = next;
  }
  known.first = kNoSlot;
  known.views = known.sightings = 0;
}

void DescriptorStore::forget_unstable(double path_m) {
  for (Known& known : known_)
    if (known.sightings < settings_.stable_sightings && path_m - known.last_seen_m > settings_.forget_after_m)
      forget(known);
  std::erase_if(known_, [](const Known& known) { return known.views == 0; });
}

/// Makes room by forgetting the identity not seen for the longest time, unstable ones first.
void DescriptorStore::forget_least_worth() {
  const auto worth_less = [this](const Known& a, const Known& b) {
    const bool a_empty = a.views == 0, b_empty = b.views == 0;
    if (a_empty != b_empty) return b_empty;
    const bool a_stable = a.sightings >= settings_.stable_sightings,
               b_stable = b.sightings >= settings_.stable_sightings;
    return a_stable != b_stable ? b_stable : a.last_seen_m < b.last_seen_m;
  };
  const auto least = std::ranges::min_element(known_, worth_less);
  if (least != known_.end()) forget(*least);
}

const Pattern& DescriptorStore::pattern(std::uint32_t slot) const {
  static const Pattern kNone;
  return slot < patterns_.size() ? patterns_[slot] : kNone;
}

}  // namespace azimuth
