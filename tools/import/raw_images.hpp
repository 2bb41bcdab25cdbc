#pragma once
// The images of a log whose pixels are not compressed, for a run folder.
//
// Thread contract: reentrant.

#include <filesystem>

#include "base/file_result.hpp"
#include "drivers/storage/run.hpp"

namespace azimuth {

/// Makes PNG files below `out`/frames of the grey and coloured ones among the run's frames, which then name them. Of
/// one that cannot be read there is no file, so that it counts as unreadable there as well. Frames of other kinds stay
/// as they are. Refuses Bayer patterns and YUV, which PNG cannot hold without loss.
FileResult<void> bring_raw_images(Run& run, const std::filesystem::path& out);

}  // namespace azimuth
