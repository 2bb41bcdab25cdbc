#include "slam/estimator/duplicates.hpp"

namespace azimuth {
namespace {

constexpr int kTogether = 5;  // two bearings in one image say more than one that went to either of them

}  // namespace

void Duplicates::observe(const BearingEkf& ekf, std::span<const Point> points) {
  if (settings_.merge_after_images <= 0) return;
  for (const Point& point : points)
    if (point.seen) count(ekf, points, point);
}

std::optional<Duplicates::Pair> Duplicates::find(const BearingEkf& ekf, std::span<const Point> points) const {
  for (const Point& point : points) {
    const auto missed = missed_.find(point.id);
    if (missed == missed_.end() || missed->second < settings_.merge_after_images) continue;
    if (const Point* twin = better_twin(ekf, points, point))
      return Pair{twin->id, point.id, ekf.may_be_one(twin->block, point.block, settings_.merge_chi2)};
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
      ++missed_[other.id];
  }
}

void Duplicates::lower(std::int64_t id, int by) {
  const auto missed = missed_.find(id);
  if (missed != missed_.end() && (missed->second -= by) <= 0) missed_.erase(missed);
}

bool Duplicates::are_twins(const BearingEkf& ekf, const Point& a, const Point& b) const {
  return a.id != b.id && same_kind(a.kind, b.kind) &&
         (ekf.state().position(a.block) - ekf.state().position(b.block)).norm() < settings_.merge_within_m;
}

/// The twin seen most often, if it was more often than `of`; the older one of equals.
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
