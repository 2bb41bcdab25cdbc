#pragma once
#include <string>
#include <string_view>

#include "sim/azimuth_sim/simulation.hpp"

namespace azimuth::sim {

/// The status of the simulation in one line, as the answer to `status`.
std::string status_text(Simulation& simulation, Stamp now);

/// Executes commands to a running simulator: faults by name, `status`, `help`, `quit`.
///
/// Thread contract: thread-bound.
class Console {
 public:
  /// `simulation` must outlive this object.
  explicit Console(Simulation& simulation) : simulation_(simulation) {}

  /// Executes one line and returns the answer, which ends in a newline. The answer to an empty line is empty.
  std::string obey(std::string_view line, Stamp now);
  bool wants_to_quit() const { return quit_; }

 private:
  Simulation& simulation_;
  bool quit_ = false;
};

}  // namespace azimuth::sim
