#pragma once
#include <string>
#include <string_view>

#include "sim/azimuth_sim/simulation.hpp"

namespace azimuth::sim {

/// How things are, as `status` answers: one line.
std::string status_text(Simulation& simulation, Stamp now);

/// Commands to a running simulator: faults by name, `status`, `help`, `quit`.
///
/// Thread contract: thread-bound.
class Console {
 public:
  /// `simulation` outlives this.
  explicit Console(Simulation& simulation) : simulation_(simulation) {}

  /// Obeys one line; the answer, ending in a newline. An empty line is a question for nothing.
  std::string obey(std::string_view line, Stamp now);
  bool wants_to_quit() const { return quit_; }

 private:
  Simulation& simulation_;
  bool quit_ = false;
};

}  // namespace azimuth::sim
