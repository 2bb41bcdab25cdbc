#include "slam/planar/planar_map.hpp"

#include <algorithm>
#include <limits>

#include "slam/estimator/rig_noise.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

// Earlier than every stamp, and far enough from the limits for differences not to overflow.
constexpr Stamp kLongAgo = stamp_from_us(std::numeric_limits<std::int64_t>::min() / 4);

// weight of two bearings in one image, against one image in which only one of the two was seen
constexpr int kTogether = 5;

}  // namespace

PlanarMap::PlanarMap(const Rig& rig, const EkfSettings& settings, Initialisation initialisation)
    : rig_(rig),
      settings_(settings),
      initialisation_(initialisation),
      candidates_(settings, rig.camera),
      duplicates_(settings.merging) {
  points_.reserve(kTypicalLandmarks);
}

void PlanarMap::restore(const MapSnapshot& map, std::span<const Index> blocks) {
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const MapLandmark& saved = map.landmarks[i];
    book_.restore({.id = saved.id,
                   .identity = saved.identity,
                   .kind = saved.kind,
                   .block = blocks[i],
                   .sightings = saved.sightings,
                   .last_used = kLongAgo,
                   .recalled = true,
                   .confirmed = true});
  }
  book_.continue_from(map.next_id);
}

void PlanarMap::forget_everything(BearingEkf& ekf) {
  while (!book_.empty()) remove(ekf, book_.size() - 1);
  deleted_ = 0;
}

void PlanarMap::tidy(BearingEkf& ekf, const Instant& now) {
  if (has_names()) return;
  confirm();
  // In a narrow view one of two near landmarks is often seen alone, so this does not show that the other is a
  // duplicate.
  if (rig_.camera.field_of_view_rad > kPi) merge_duplicates(ekf, now.stamp);
  drop_on_probation(ekf, now.path_m);
}

bool PlanarMap::is_seen_often(const PlanarLandmark& landmark) const {
  return landmark.sightings >= static_cast<std::uint64_t>(settings_.probation.confirm_after_sightings);
}

void PlanarMap::confirm() {
  for (PlanarLandmark& landmark : book_.entries()) {
    if (landmark.confirmed || !is_seen_often(landmark)) continue;
    landmark.confirmed = true;
    ++created_;
  }
}

void PlanarMap::merge_duplicates(BearingEkf& ekf, Stamp stamp) {
  list_points(stamp);
  duplicates_.observe(ekf, points_);
  while (const auto pair = duplicates_.find(ekf, points_)) {
    merge(ekf, *pair);
    list_points(stamp);
  }
}

void PlanarMap::list_points(Stamp stamp) {
  points_.clear();
  for (const PlanarLandmark& landmark : book_.entries())
    if (landmark.is_point())
      points_.push_back({landmark.id, landmark.kind, landmark.block, landmark.sightings, landmark.last_used == stamp});
}

void PlanarMap::merge(BearingEkf& ekf, const Duplicates::Pair& pair) {
  const std::size_t kept = book_.index_of(pair.keep), dropped = book_.index_of(pair.drop);
  if (!pair.agree) return remove(ekf, dropped);
  ekf.merge(book_[kept].block, book_[dropped].block);
  forget(dropped);
}

/// Removes clutter: landmarks seen once or twice and never again.
void PlanarMap::drop_on_probation(BearingEkf& ekf, double path_m) {
  for (std::size_t i = book_.size(); i-- > 0;)
    if (!is_seen_often(book_[i]) && path_m - book_[i].last_used_m > settings_.probation.drop_after_m) remove(ekf, i);
}

bool PlanarMap::add(BearingEkf& ekf, std::span<const Bearing> unmapped, const Instant& now) {
  const std::int64_t before = book_.next_id();
  const auto most = as_size(settings_.max_landmarks);
  unmapped = unmapped.first(std::min(unmapped.size(), most - std::min(most, book_.size())));
  if (initialisation_ == Initialisation::undelayed) {
    add_rays(ekf, unmapped, now);
  } else {
    candidates_.observe(ekf, unmapped);
    for (const Candidates::Created& created : candidates_.created())
      add({.identity = created.identity, .kind = created.kind, .block = created.block}, created.sightings,
          created.radius_px, now);
  }
  return book_.next_id() != before;
}

void PlanarMap::add_rays(BearingEkf& ekf, std::span<const Bearing> unmapped, const Instant& now) {
  for (const Bearing& bearing : unmapped) {
    const Index block =
        ekf.add_ray(bearing.azimuth_rad, sigma_rad(bearing, rig_.camera), settings_.undelayed.inverse_depth_mean_per_m,
                    settings_.undelayed.inverse_depth_sigma_per_m, bearing.radius_px);
    add({.identity = bearing.identity, .kind = bearing.kind, .block_kind = BlockKind::inverse_depth, .block = block}, 1,
        bearing.radius_px, now);
  }
}

void PlanarMap::add(PlanarLandmark landmark, std::uint64_t sightings, double radius_px, const Instant& now) {
  landmark.was_seen(radius_px, now.path_m, now.stamp);
  landmark.sightings = sightings;
  landmark.confirmed = starts_confirmed() || is_seen_often(landmark);
  book_.add(landmark);
  created_ += landmark.confirmed ? 1 : 0;
}

void PlanarMap::promote_converged(BearingEkf& ekf) {
  if (initialisation_ != Initialisation::undelayed) return;
  for (PlanarLandmark& landmark : book_.entries()) {
    if (landmark.block_kind != BlockKind::inverse_depth ||
        !(ekf.linearity_index(landmark.block) < settings_.undelayed.promote_linearity))
      continue;
    ekf.promote(landmark.block);
    landmark.block_kind = BlockKind::point;
  }
}

std::size_t PlanarMap::remove_contradicted(BearingEkf& ekf, int rejected_in_row) {
  std::size_t removed = 0;
  for (std::size_t i = book_.size(); i-- > 0;) {
    if (book_[i].rejected_in_row < rejected_in_row) continue;
    remove(ekf, i);
    ++removed;
  }
  return removed;
}

void PlanarMap::remove(BearingEkf& ekf, std::size_t at) {
  ekf.remove(book_[at].block, book_[at].block_kind);
  forget(at);
}

void PlanarMap::forget(std::size_t at) {
  duplicates_.forget(book_[at].id);
  deleted_ += book_[at].confirmed ? 1 : 0;
  book_.remove(at);
}

void Duplicates::observe(const BearingEkf& ekf, std::span<const Point> points) {
  if (settings_.after_images <= 0) return;
  for (const Point& point : points)
    if (point.seen) count(ekf, points, point);
}

std::optional<Duplicates::Pair> Duplicates::find(const BearingEkf& ekf, std::span<const Point> points) const {
  for (const Point& point : points) {
    if (missed(point.id) < std::max(1, settings_.after_images)) continue;
    if (const Point* twin = better_twin(ekf, points, point))
      return Pair{twin->id, point.id, ekf.may_be_one(twin->block, point.block, settings_.chi2)};
  }
  return std::nullopt;
}

void Duplicates::count(const BearingEkf& ekf, std::span<const Point> points, const Point& seen) {
  lower(seen.id, 1);
  for (const Point& other : points) {
    if (!are_twins(ekf, seen, other)) continue;
    if (other.seen)
      lower(other.id, kTogether);
    else
      raise(other.id);
  }
}

int Duplicates::missed(std::int64_t id) const {
  const auto found = std::ranges::find(missed_, id, &Missed::id);
  return found != missed_.end() ? found->images : 0;
}

void Duplicates::raise(std::int64_t id) {
  const auto found = std::ranges::find(missed_, id, &Missed::id);
  if (found != missed_.end())
    ++found->images;
  else
    missed_.push_back({id, 1});
}

void Duplicates::lower(std::int64_t id, int by) {
  const auto found = std::ranges::find(missed_, id, &Missed::id);
  if (found != missed_.end() && (found->images -= by) <= 0) missed_.erase(found);
}

bool Duplicates::are_twins(const BearingEkf& ekf, const Point& a, const Point& b) const {
  return a.id != b.id && a.kind != kAnyKind && a.kind == b.kind &&
         (ekf.state().position(a.block) - ekf.state().position(b.block)).norm() < settings_.within_m;
}

/// The twin seen most often, if it was seen more often than `of`. Of twins seen equally often, the older one.
const Duplicates::Point* Duplicates::better_twin(const BearingEkf& ekf, std::span<const Point> points,
                                                 const Point& of) const {
  const auto is_better = [](const Point& a, const Point& b) {
    return a.sightings != b.sightings ? a.sightings > b.sightings : a.id < b.id;
  };
  const Point* best = nullptr;
  for (const Point& other : points)
    if (are_twins(ekf, of, other) && is_better(other, best != nullptr ? *best : of)) best = &other;
  return best;
}

}  // namespace azimuth
