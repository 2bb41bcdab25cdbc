#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "slam/estimator/estimate.hpp"
#include "slam/estimator/reading_clock.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// Decides which samples are accepted, by their own numbers and stamps, and counts the others.
///
/// Thread contract: thread-bound. Nothing allocates once sets have had their largest size.
class SampleIntake {
 public:
  explicit SampleIntake(const ReadingClock& clock) : clock_(clock) { by_name_.reserve(kTypicalBearings); }

  /// Returns false for a reading that is not finite, out of order, or too late for a set that was given up waiting.
  bool takes(const OdometryReading& reading);
  /// Returns false for a set that is out of order.
  bool takes(const BearingSet& set);
  /// Removes unusable bearings from a set.
  void keep_usable(BearingSet& set);
  /// Drops names that occur more than once in an image. At most one of the bearings with the same name is right, and
  /// the name does not tell which, so all of them lose it. Bearings that agree within their noise (`sigma_bearing_rad`
  /// for those that carry none) are repeated detections of one landmark: the first of them keeps the name. Dropped
  /// names are counted.
  void doubt_repeated_names(BearingSet& set, double sigma_bearing_rad);
  /// No set waits any more for readings up to `stamp`.
  void gave_up_until(Stamp stamp) { given_up_until_ = stamp; }
  void refused_set() { ++counts_.bearings_without_odometry; }

  /// Stamp of the newest set; there must be one.
  Stamp newest_set() const { return *newest_set_; }
  const InputCounts& counts() const { return counts_; }
  std::uint64_t names_doubted() const { return names_doubted_; }  ///< Bearings that lost their names so far

 private:
  ReadingClock clock_;
  std::optional<std::uint64_t> newest_reading_;  // sequence number
  std::optional<Stamp> last_reading_, newest_set_, given_up_until_;
  std::uint64_t newest_sequence_ = 0;
  InputCounts counts_;
  std::vector<std::size_t> by_name_;  // indices of bearings of a set, sorted by name
  std::uint64_t names_doubted_ = 0;
};

/// Bearing sets that wait for their odometry, in the order of their stamps.
///
/// Thread contract: thread-bound. Nothing allocates once sets have had their largest size.
class WaitingSets {
 public:
  WaitingSets();

  bool empty() const { return count_ == 0; }
  bool full() const { return count_ == kMost; }
  const BearingSet& first() const { return sets_[first_]; }
  BearingSet& first() { return sets_[first_]; }
  /// Adds a set by swapping storage: `set` is empty afterwards. There must be room.
  void add(BearingSet& set);
  void drop_first();

 private:
  static constexpr std::size_t kMost = 512;
  std::vector<BearingSet> sets_;  // ring
  std::size_t first_ = 0, count_ = 0;
};

}  // namespace azimuth
