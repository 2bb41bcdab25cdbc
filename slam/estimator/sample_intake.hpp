#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "slam/estimator/estimate.hpp"
#include "slam/estimator/reading_clock.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// Which samples are taken, by their own numbers and stamps, and what is counted of the others.
///
/// Thread contract: thread-bound. Nothing allocates once sets have had their largest size.
class SampleIntake {
 public:
  explicit SampleIntake(const ReadingClock& clock) : clock_(clock) { by_name_.reserve(kTypicalBearings); }

  /// False: it is not finite, not in order, or later than something that was given up for want of it.
  bool takes(const OdometryReading& reading);
  /// False: it is not in order.
  bool takes(const BearingSet& set);
  /// Takes out of a set what cannot be used.
  void keep_usable(BearingSet& set);
  /// Of the bearings of one image that have the same name one at most is right, and the name does not tell which: all
  /// of them lose it. Those that agree within their noise (`sigma_bearing_rad` where they say none) are of one thing
  /// that was found several times, and the first keeps it. How many lost theirs is counted.
  void doubt_repeated_names(BearingSet& set, double sigma_bearing_rad);
  /// Nothing waits any more for readings up to here.
  void gave_up_until(Stamp stamp) { given_up_until_ = stamp; }
  void refused_set() { ++counts_.bearings_without_odometry; }

  /// Of the newest set; there must be one.
  Stamp newest_set() const { return *newest_set_; }
  const InputCounts& counts() const { return counts_; }
  std::uint64_t names_doubted() const { return names_doubted_; }  ///< bearings that lost theirs so far

 private:
  ReadingClock clock_;
  std::optional<std::uint64_t> newest_reading_;  // sequence number
  std::optional<Stamp> last_reading_, newest_set_, given_up_until_;
  std::uint64_t newest_sequence_ = 0;
  InputCounts counts_;
  std::vector<std::size_t> by_name_;  // bearings of a set
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
  /// Takes it by swapping storage: `set` is empty afterwards. There must be room.
  void add(BearingSet& set);
  void drop_first();

 private:
  static constexpr std::size_t kMost = 512;
  std::vector<BearingSet> sets_;  // ring
  std::size_t first_ = 0, count_ = 0;
};

}  // namespace azimuth
