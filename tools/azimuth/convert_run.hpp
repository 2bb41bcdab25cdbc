#pragma once
// Converts a run between its two forms, run folder and LCM log.

#include <filesystem>

#include "drivers/storage/run.hpp"

namespace azimuth {

struct Conversion {
  std::filesystem::path in, out;  ///< the ending of `out` chooses the form, see is_log_name()
  LogOptions log{.odometry_alone = true};
  bool force = false;  ///< replace `out`
};

/// Whether convert() accepts the path: an LCM log, a run folder or a daemon's session folder.
bool is_run(const std::filesystem::path& path);

/// Writes the run to `out` and prints its content. Throws CommandError if the run cannot be read or written.
void convert(const Conversion& conversion);

}  // namespace azimuth
