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

/// A filter's bookkeeping for landmarks, apart from its state: entries in no particular order, each with an identifier
/// that is never reused (`std::int64_t id`).
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

  /// Adds a landmark under a new identifier.
  Landmark& add(Landmark landmark) {
    landmark.id = next_id_++;
    return entries_.emplace_back(std::move(landmark));
  }
  /// Adds a landmark of another run under the identifier it had there.
  void restore(Landmark landmark) { entries_.push_back(std::move(landmark)); }
  /// Removes an entry; the last entry takes its place.
  void remove(std::size_t at) {
    entries_[at] = std::move(entries_.back());
    entries_.pop_back();
  }

  /// Index of the entry with this identifier, which must exist.
  std::size_t index_of(std::int64_t id) const {
    return as_size(std::ranges::find(entries_, id, &Landmark::id) - entries_.begin());
  }

  /// No landmark has been given this identifier or a higher one.
  std::int64_t next_id() const { return next_id_; }
  void continue_from(std::int64_t next_id) { next_id_ = next_id; }

 private:
  std::vector<Landmark> entries_;
  std::int64_t next_id_ = 0;
};

}  // namespace azimuth
