#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "slam/estimator/estimate.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {

/// What a filter knows of each landmark beside its state: entries in no order, each with an identifier that is never
/// used again (`std::int64_t id`).
///
/// Thread contract: thread-bound. Nothing allocates once the map has had its largest size.
template <class Landmark>
class LandmarkBook {
 public:
  LandmarkBook() { entries_.reserve(kTypicalLandmarks); }

  std::span<const Landmark> entries() const { return entries_; }
  std::span<Landmark> entries() { return entries_; }
  std::size_t size() const { return entries_.size(); }
  bool empty() const { return entries_.empty(); }
  const Landmark& operator[](std::size_t at) const { return entries_[at]; }
  Landmark& operator[](std::size_t at) { return entries_[at]; }

  /// Enters a landmark under a new identifier.
  Landmark& add(Landmark landmark) {
    landmark.id = next_id_++;
    return entries_.emplace_back(std::move(landmark));
  }
  /// Enters one of another run's under the identifier it had there.
  void restore(Landmark landmark) { entries_.push_back(std::move(landmark)); }
  /// Strikes one out; the last entry takes its place.
  void remove(std::size_t at) {
    entries_[at] = std::move(entries_.back());
    entries_.pop_back();
  }

  /// Of the identifier; it must be there.
  std::size_t index_of(std::int64_t id) const {
    return as_size(std::ranges::find(entries_, id, &Landmark::id) - entries_.begin());
  }

  /// Identifiers from this one on have never been given.
  std::int64_t next_id() const { return next_id_; }
  void continue_from(std::int64_t next_id) { next_id_ = next_id; }

 private:
  std::vector<Landmark> entries_;
  std::int64_t next_id_ = 0;
};

}  // namespace azimuth
