#pragma once
// Faults by name, for the command line and for commands to a running simulator: NAME or NAME=VALUE. Their schedule:
// single ones at given instants, and a list that is repeated cyclically.

#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "sim/pioneer/simulated_pioneer.hpp"

namespace azimuth::sim {

struct FaultKind;

/// A parsed fault. It lasts until the same name is given another value, except for transient faults (reboot, unplug,
/// silence).
class Fault {
 public:
  void apply(SimulatedPioneer& pioneer) const;
  std::string text() const;

 private:
  friend tl::expected<Fault, std::string> parse_fault(std::string_view text);
  Fault(const FaultKind& kind, double value) : kind_(&kind), value_(value) {}

  const FaultKind* kind_;
  double value_;
};

/// Returns the fault, or the error in the text.
tl::expected<Fault, std::string> parse_fault(std::string_view text);

/// One line for each fault: name, values, meaning.
std::string fault_help();

struct TimedFault {
  Stamp at{};
  Fault fault;
};

/// Parses SECONDS:NAME[=VALUE]; returns the error in the text if there is one.
tl::expected<TimedFault, std::string> parse_timed_fault(std::string_view text);

/// Thread contract: thread-bound.
class FaultSchedule {
 public:
  FaultSchedule() = default;
  /// `cycle`: one fault each `period`, in order and repeatedly; may be empty.
  FaultSchedule(std::vector<TimedFault> once, std::vector<Fault> cycle, Duration period);

  /// Instant of the next fault; Stamp::max() if there is none.
  Stamp due() const;
  /// Returns the faults that are due, in order.
  std::vector<Fault> take(Stamp now);

 private:
  Stamp once_due() const { return next_once_ < once_.size() ? once_[next_once_].at : Stamp::max(); }
  Stamp cycle_due() const { return cycle_.empty() ? Stamp::max() : next_cycle_at_; }
  Fault take_one();

  std::vector<TimedFault> once_;  // Sorted by time
  std::vector<Fault> cycle_;
  Duration period_{};
  Stamp next_cycle_at_{};
  std::size_t next_once_ = 0, next_in_cycle_ = 0;
};

}  // namespace azimuth::sim
