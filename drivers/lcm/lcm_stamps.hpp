#pragma once
#include <chrono>
#include <cstdint>
#include <optional>

#include "drivers/lcm/lcm_settings.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// The time of arrival of a datagram, on the daemon's own time. That time started from the wall clock and advances
/// evenly.
struct LcmReceipt {
  Stamp stamp{};
  /// How far the wall clock is now ahead of the daemon's own time. The wall clock may have been set since the start.
  Duration wall_lead{};
};

/// How far the wall clock is ahead of the daemon's own time. The two clocks are read one after the other, and the
/// thread may sleep in between. So the value is changed only by readings close together, and only when the wall clock
/// has really been set.
///
/// Thread contract: thread-bound.
class LcmWallLead {
 public:
  static constexpr Duration kClose{100}, kMoved{500};

  /// Takes a reading `wall` of the wall clock, made between `before` and `after`.
  void look(Stamp before, Stamp wall, Stamp after) {
    const Duration lead = wall - (before + (after - before) / 2);
    const bool has_moved = after - before <= kClose && std::chrono::abs(lead - value()) > kMoved;
    if (!lead_ || has_moved) lead_ = lead;
  }
  Duration value() const { return lead_.value_or(Duration{}); }

 private:
  std::optional<Duration> lead_;
};

/// The counters of wrong stamps.
struct LcmStampCounts {
  std::uint64_t too_old = 0;       ///< samples whose stamp was too old at their arrival
  std::uint64_t in_future = 0;     ///< samples whose stamp was in the future at their arrival
  std::uint64_t out_of_order = 0;  ///< samples whose stamp was not newer than the newest one
  /// Stamp minus wall clock at arrival [s], for the last sample whose stamp was too old or in the future.
  double last_off_s = 0.0;

  std::uint64_t misdated() const { return too_old + in_future; }
};

/// Turns the senders' times into plausible stamps that strictly increase. Samples with wrong times are dropped rather
/// than stamped by their arrival, because the arrival depends on the scheduler, and an estimate from wrong stamps is
/// worse than none. LcmStampKind::receipt selects stamps by arrival explicitly.
///
/// Thread contract: thread-bound.
class LcmStamps {
 public:
  /// Tolerance for stamps ahead of their arrival: the wall clock may be adjusted between the two readings.
  static constexpr Duration kTolerance{20'000};

  LcmStamps(LcmStampKind kind, Duration max_age) : kind_(kind), max_age_(max_age) {}

  /// `said` is the sender's utime. None: the sample is to be dropped; this is counted.
  std::optional<Stamp> judge(Stamp said, const LcmReceipt& receipt);

  const LcmStampCounts& counts() const { return counts_; }

 private:
  std::optional<Stamp> by_sender(Stamp said, const LcmReceipt& receipt);
  std::nullopt_t misdated(std::uint64_t& count, Stamp said, const LcmReceipt& receipt);

  LcmStampKind kind_;
  Duration max_age_;
  Stamp newest_ = Stamp::min();
  LcmStampCounts counts_;
};

}  // namespace azimuth
