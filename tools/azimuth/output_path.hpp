#pragma once
#include <filesystem>

#include "drivers/io/run.hpp"

namespace azimuth {

/// Where a run is written to: an LCM log when the name ends in .lcmlog, .lcm or .log, else a folder.
bool is_log_name(const std::filesystem::path& out);

/// Refuses an output that exists already unless `force`. A folder that is there but empty is no obstacle.
void check_output(const std::filesystem::path& out, bool force);

/// Writes in the form that the name asks for.
void write_run(const Run& run, const std::filesystem::path& out);

}  // namespace azimuth
