#pragma once
// Converts uncompressed images of a log for a run folder.
//
// Thread contract: reentrant.

#include <filesystem>

#include "base/file_result.hpp"
#include "drivers/storage/run.hpp"

namespace azimuth {

/// Writes the uncompressed grey and colour frames of the run as PNG files below `out`/frames and updates run.frames. An
/// unreadable frame gets no file, so that it counts as unreadable in the run folder too. Other frames stay unchanged.
/// Rejects Bayer patterns and YUV, which PNG cannot hold without loss.
FileResult<void> bring_raw_images(Run& run, const std::filesystem::path& out);

}  // namespace azimuth
