#pragma once
// Faults by name, for the command line and for commands to a running simulator: NAME or NAME=VALUE.

#include <string>
#include <string_view>
#include <tl/expected.hpp>

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

}  // namespace azimuth::sim
