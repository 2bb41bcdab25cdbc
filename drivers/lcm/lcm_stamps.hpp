#pragma once
#include <chrono>
#include <cstdint>
#include <optional>

#include "drivers/lcm/lcm_settings.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// When a datagram came, on the daemon's own time, which runs evenly from what the wall clock said at the start.
struct LcmReceipt {
  Stamp stamp{};
  Duration wall_lead{};  ///< what the wall clock leads that time by now: it may have been set since
};

/// What the wall clock leads the daemon's own time by. The two are read one after the other, and the thread may sleep
/// in between; so what is known is changed only by readings close together, and only when the clock has really been
/// moved.
///
/// Thread contract: thread-bound.
class LcmWallLead {
 public:
  static constexpr Duration kClose{100}, kMoved{500};

  /// The wall clock said `wall` between `before` and `after`.
  void look(Stamp before, Stamp wall, Stamp after) {
    const Duration lead = wall - (before + (after - before) / 2);
    const bool has_moved = after - before <= kClose && std::chrono::abs(lead - value()) > kMoved;
    if (!lead_ || has_moved) lead_ = lead;
  }
  Duration value() const { return lead_.value_or(Duration{}); }

 private:
  std::optional<Duration> lead_;
};

/// What was wrong with stamps.
struct LcmStampCounts {
  std::uint64_t too_old = 0;       ///< at their arrival
  std::uint64_t in_future = 0;     ///< at their arrival
  std::uint64_t out_of_order = 0;  ///< not newer than the newest
  double last_off_s =
      0.0;  ///< of those too old or in the future, the last one's stamp less the wall clock at its arrival

  std::uint64_t misdated() const { return too_old + in_future; }
};

/// Turns what senders say of time into stamps that ascend strictly and can be true. Samples that cannot be dated are
/// dropped rather than dated by their arrival: that measures the scheduler, not the robot, and an estimate from wrong
/// stamps is worse than none. Who wants it all the same says so (LcmStampKind::receipt).
///
/// Thread contract: thread-bound.
class LcmStamps {
 public:
  /// A stamp may lie so far ahead of its arrival: two readings of the wall clock while it is being adjusted.
  static constexpr Duration kTolerance{20'000};

  LcmStamps(LcmStampKind kind, Duration max_age) : kind_(kind), max_age_(max_age) {}

  /// `said` is the sender's utime. Nothing: the sample is to be dropped, which is counted.
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
