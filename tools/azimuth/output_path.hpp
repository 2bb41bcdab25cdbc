#pragma once
#include <filesystem>

#include "drivers/storage/write_run_log.hpp"

namespace azimuth {

/// Where a run is written to: an LCM log when the name ends in .lcmlog, .lcm or .log, else a folder.
bool is_log_name(const std::filesystem::path& out);

/// Refuses an output that exists already unless `force`. A folder that is there but empty is no obstacle.
void check_output(const std::filesystem::path& out, bool force);

/// Refuses the name of a picture whose ending is of no format that can be drawn.
void check_picture_name(const std::filesystem::path& file);

/// Fails where a file could not be written, so that nobody waits for what then is lost. Nothing is left behind, and a
/// file that is there stays as it is. An empty path, and what is no regular file, is passed over.
void check_writable(const std::filesystem::path& file);

/// Writes in the form that the name asks for. A log is there as a whole or, when that fails or `progress` throws, as it
/// was before.
void write_run(const Run& run, const std::filesystem::path& out, const WriteProgress& progress = {});

}  // namespace azimuth
