#pragma once
// Faults by name, as the command line and people at a running simulator say them: NAME or NAME=VALUE.

#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "sim/pioneer/simulated_pioneer.hpp"

namespace azimuth::sim {

struct FaultKind;

/// A fault that was understood. It lasts until the same name is given another value, apart from those that pass by
/// themselves (reboot, unplug, silence).
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

/// The fault, or what is wrong with the text.
tl::expected<Fault, std::string> parse_fault(std::string_view text);

/// One line a fault: name, values, meaning.
std::string fault_help();

}  // namespace azimuth::sim
