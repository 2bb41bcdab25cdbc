#include "slam/planar/duplicates.hpp"

#include <algorithm>

namespace azimuth {
namespace {

// weight of two bearings in one image, against one image in which only one of the two was seen
constexpr int kTogether = 5;

}  // namespace

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
