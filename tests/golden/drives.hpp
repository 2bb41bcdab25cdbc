#pragma once
// The drives whose trajectories are kept: each is shipped, or made here from a seed.

#include <ostream>
#include <span>
#include <string_view>

#include "tests/golden/trajectory.hpp"

namespace azimuth::golden {

struct Drive {
  std::string_view name;  ///< of its file, trajectories/NAME.txt
  /// Every step, with the settings and the estimator that somebody gets who sets none, as far as the name does not say
  /// otherwise.
  Trajectory (*run)();
};

/// For GoogleTest, which names the case.
inline void PrintTo(const Drive& drive, std::ostream* out) { *out << drive.name; }

std::span<const Drive> drives();

}  // namespace azimuth::golden
