#include "slam/planar/feature_identities.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "slam/association/feature_patterns.hpp"
#include "slam/association/view_interval.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr double kNowhere = -1.0;  // half width of an empty interval

DescriptorStoreSettings store_settings(const IdentitySettings& settings, double max_viewing_distance_m) {
  DescriptorStoreSettings store;
  store.max_viewing_distance_m = max_viewing_distance_m;
  store.max_views = settings.max_views;
  store.views_per_identity = settings.views_per_identity;
  store.view_spacing_m = settings.view_spacing_m;
  store.stable_sightings = settings.stable_sightings;
  store.forget_after_m = settings.forget_after_m;
  store.keep_patterns = settings.validation != FeatureValidation::geometry;
  return store;
}

}  // namespace

FeatureIdentities::FeatureIdentities(const IdentitySettings& settings, double sigma_bearing_rad,
                                     double max_viewing_distance_m)
    : settings_(settings),
      sigma_bearing_rad_(sigma_bearing_rad),
      max_viewing_distance_m_(max_viewing_distance_m),
      store_(store_settings(settings, max_viewing_distance_m)) {}

void FeatureIdentities::restore(std::span<const MapView> views, Identity next) {
  store_.restore(views);
  next_ = next;
}

const BearingSet& FeatureIdentities::name(const BearingSet& image, const IdentityBeliefs& beliefs) {
  image_ = image;
  for (Bearing& bearing : image_.bearings) bearing.identity = kUnknownIdentity;
  found_.clear();
  if (image_.descriptors.size() != image_.bearings.size()) return image_;
  const std::uint64_t recognised_before = counts_.mapped;
  p_map_camera_m_ = beliefs.T_map_camera.position();
  look_up(beliefs);
  for (std::size_t at = 0; at < image_.bearings.size(); ++at)
    if (judge(at, beliefs) == Verdict::again) image_.bearings[at].identity = found_[at].nearest.identity;
  spread_noise(static_cast<double>(counts_.mapped - recognised_before));
  for (Bearing& bearing : image_.bearings)
    if (bearing.identity == kUnknownIdentity) bearing.identity = next_++;
  return image_;
}

void FeatureIdentities::look_up(const IdentityBeliefs& beliefs) {
  if (beliefs.anywhere || !settings_.rivals_elsewhere)
    return store_.find(image_.descriptors, p_map_camera_m_, found_, beliefs.anywhere);
  list_within(beliefs);
  store_.forget_all_but(within_);
  azimuths_rad_.clear();
  for (const Bearing& bearing : image_.bearings) azimuths_rad_.push_back(bearing.azimuth_rad);
  store_.find_within(image_.descriptors, azimuths_rad_, within_, p_map_camera_m_, found_);
}

/// Lists the directions in which each known landmark can be seen, using the largest noise of the image's bearings;
/// judge() then applies each bearing's own noise. A landmark that is not in the map yet has one interval per earlier
/// bearing, of which the narrowest is used.
void FeatureIdentities::list_within(const IdentityBeliefs& beliefs) {
  double worst_rad2 = 0.0;
  for (const Bearing& bearing : image_.bearings) worst_rad2 = std::max(worst_rad2, variance_rad2(bearing));
  within_.clear();
  for (const IdentityBeliefs::Mapped& mapped : beliefs.mapped) {
    if (std::isnan(mapped.azimuth_rad))
      within_.push_back({mapped.identity, 0.0, kNowhere});
    else
      within_.push_back(
          {mapped.identity, mapped.azimuth_rad, std::sqrt(settings_.gate_chi2 * (mapped.variance_rad2 + worst_rad2))});
  }
  for (const IdentityBeliefs::Sighted& earlier : beliefs.sighted) {
    const auto interval =
        view_interval(earlier.p_map_camera_m, earlier.direction_rad, p_map_camera_m_, max_viewing_distance_m_);
    SightedWithin within{earlier.identity, 0.0, kNowhere};
    if (interval) {
      within.azimuth_rad = wrap(interval->start_rad + 0.5 * interval->sweep_rad - beliefs.T_map_camera.heading_rad);
      within.half_width_rad = 0.5 * std::abs(interval->sweep_rad) +
                              view_margin_rad(earlier.variance_rad2, worst_rad2, earlier.variance_turn_rad2);
    }
    if (within_.empty() || within_.back().identity != earlier.identity)
      within_.push_back(within);
    else if (within.half_width_rad < within_.back().half_width_rad)
      within_.back() = within;
  }
  std::ranges::sort(within_, std::less{}, &SightedWithin::identity);
}

/// Decision tree of mathematics I.12.
FeatureIdentities::Verdict FeatureIdentities::judge(std::size_t at, const IdentityBeliefs& beliefs) {
  const auto fresh = [](std::uint64_t& reason) {
    ++reason;
    return Verdict::fresh;
  };
  const auto again = [](std::uint64_t& reason) {
    ++reason;
    return Verdict::again;
  };
  const NearestTwo& two = found_[at];
  const Identity identity = two.nearest.identity;
  if (identity == kUnknownIdentity || two.ratio() > settings_.max_ratio) return fresh(counts_.unlike);
  if (is_outdone(at)) return fresh(counts_.outdone);
  if (beliefs.anywhere) return again(counts_.mapped);
  const auto mapped =
      std::ranges::lower_bound(beliefs.mapped, identity, std::less{}, &IdentityBeliefs::Mapped::identity);
  if (mapped != beliefs.mapped.end() && mapped->identity == identity)
    return agrees_with_map(image_.bearings[at], *mapped) ? again(counts_.mapped) : fresh(counts_.contradicted);
  const std::less<> before;
  const auto first = std::ranges::lower_bound(beliefs.sighted, identity, before, &IdentityBeliefs::Sighted::identity);
  const auto last = std::ranges::upper_bound(beliefs.sighted, identity, before, &IdentityBeliefs::Sighted::identity);
  const std::span<const IdentityBeliefs::Sighted> sighted(first, last);
  if (!sighted.empty())
    return agrees_with_sightings(at, sighted, beliefs) ? again(counts_.sighted) : fresh(counts_.contradicted);
  store_.forget(identity);
  return fresh(counts_.replaced);
}

/// Whether another feature of the image matches the same landmark better; of equally good features the first one wins.
bool FeatureIdentities::is_outdone(std::size_t at) const {
  const NearestTwo::View& mine = found_[at].nearest;
  for (std::size_t other = 0; other < found_.size(); ++other) {
    const NearestTwo::View& its = found_[other].nearest;
    if (its.identity != mine.identity || other == at) continue;
    if (its.squared_distance < mine.squared_distance) return true;
    if (its.squared_distance == mine.squared_distance && other < at) return true;
  }
  return false;
}

bool FeatureIdentities::agrees_with_map(const Bearing& bearing, const IdentityBeliefs::Mapped& mapped) const {
  const double innovation_rad = wrap(bearing.azimuth_rad - mapped.azimuth_rad);
  return innovation_rad * innovation_rad < settings_.gate_chi2 * (mapped.variance_rad2 + variance_rad2(bearing));
}

bool FeatureIdentities::agrees_with_sightings(std::size_t at, std::span<const IdentityBeliefs::Sighted> sighted,
                                              const IdentityBeliefs& beliefs) const {
  if (settings_.validation == FeatureValidation::patterns) return has_the_surroundings(at);
  const Bearing& bearing = image_.bearings[at];
  const double direction_rad = wrap(beliefs.T_map_camera.heading_rad + bearing.azimuth_rad);
  double narrowest_rad = kPi;
  for (const IdentityBeliefs::Sighted& earlier : sighted) {
    const auto interval =
        view_interval(earlier.p_map_camera_m, earlier.direction_rad, p_map_camera_m_, max_viewing_distance_m_);
    const double margin_rad =
        view_margin_rad(earlier.variance_rad2, variance_rad2(bearing), earlier.variance_turn_rad2);
    if (!interval || !interval->contains(direction_rad, margin_rad)) return false;
    narrowest_rad = std::min(narrowest_rad, std::abs(interval->sweep_rad));
  }
  if (settings_.validation == FeatureValidation::geometry) return true;
  return narrowest_rad <= settings_.combined_sweep_rad || has_the_surroundings(at);
}

bool FeatureIdentities::has_the_surroundings(std::size_t at) const {
  const Pattern now = pattern_of(image_, at);
  const std::size_t matched =
      matched_members(now.seen(), store_.pattern(found_[at].nearest.slot).seen(), settings_.pattern_correlation);
  return matched >= as_size(settings_.pattern_members);
}

double FeatureIdentities::sigma_rad(const Bearing& bearing) const {
  const double own_rad = std::isnan(bearing.sigma_rad) ? sigma_bearing_rad_ : bearing.sigma_rad;
  return std::max(own_rad, settings_.min_sigma_rad);
}

/// Inflates the noise of bearings in an image with many recognised features. An error of the whole image (its stamp,
/// the mirror's shape, the filter's linearisation) affects all its bearings and does not average out.
void FeatureIdentities::spread_noise(double recognised) {
  const int independent = settings_.independent_bearings;
  const double factor = independent > 0 ? std::sqrt(std::max(1.0, recognised / independent)) : 1.0;
  for (Bearing& bearing : image_.bearings) bearing.sigma_rad = factor * sigma_rad(bearing);
}

void FeatureIdentities::refuse(Identity identity) {
  for (Bearing& bearing : image_.bearings)
    if (bearing.identity == identity) bearing.identity = kUnknownIdentity;
}

void FeatureIdentities::learn(double path_m) {
  if (image_.descriptors.size() == image_.bearings.size())
    for (std::size_t at = 0; at < image_.bearings.size(); ++at)
      if (image_.bearings[at].identity != kUnknownIdentity)
        store_.see(image_.bearings[at].identity, image_.descriptors[at], pattern_of(image_, at), p_map_camera_m_,
                   path_m);
  store_.forget_unstable(path_m);
}

}  // namespace azimuth
