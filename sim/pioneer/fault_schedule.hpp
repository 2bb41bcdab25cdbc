#pragma once
// When faults come: once each at an instant, and one after the other from a list, again and again.

#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "sim/pioneer/fault.hpp"

namespace azimuth::sim {

struct TimedFault {
  Stamp at{};
  Fault fault;
};

/// SECONDS:NAME[=VALUE]; or what is wrong with the text.
tl::expected<TimedFault, std::string> parse_timed_fault(std::string_view text);

/// Thread contract: thread-bound.
class FaultSchedule {
 public:
  FaultSchedule() = default;
  /// `cycle`: one of them each `period`, in order; none when it is empty.
  FaultSchedule(std::vector<TimedFault> once, std::vector<Fault> cycle, Duration period);

  /// When the next fault comes; never is Stamp::max().
  Stamp due() const;
  /// Those that are due, in order.
  std::vector<Fault> take(Stamp now);

 private:
  Stamp once_due() const { return next_once_ < once_.size() ? once_[next_once_].at : Stamp::max(); }
  Stamp cycle_due() const { return cycle_.empty() ? Stamp::max() : next_cycle_at_; }
  Fault take_one();

  std::vector<TimedFault> once_;  // by time
  std::vector<Fault> cycle_;
  Duration period_{};
  Stamp next_cycle_at_{};
  std::size_t next_once_ = 0, next_in_cycle_ = 0;
};

}  // namespace azimuth::sim
