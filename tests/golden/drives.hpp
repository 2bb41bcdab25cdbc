#pragma once
// The drives whose trajectories are kept. Each drive is shipped, or generated here from a seed.

#include <ostream>
#include <span>
#include <string_view>

#include "tests/golden/trajectory.hpp"

namespace azimuth::golden {

struct Drive {
  std::string_view name;  ///< Name of its file, trajectories/NAME.txt
  /// Returns every step. Settings and estimator have their default values unless the name says otherwise.
  Trajectory (*run)();
};

/// GoogleTest prints the name of a failing case with this function.
inline void PrintTo(const Drive& drive, std::ostream* out) { *out << drive.name; }

std::span<const Drive> drives();

}  // namespace azimuth::golden
