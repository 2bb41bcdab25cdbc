#pragma once
#include <filesystem>

#include "drivers/io/run.hpp"

namespace azimuth {

/// Reads truth.csv, and landmarks.csv unless its path is empty, in the form they have in run folders, in place of what
/// `run` holds of either: for a recording whose truth is known elsewhere, stamped by the same clock. All errors of both
/// files; `run` is then left as it was. Reentrant.
FileErrors replace_truth(Run& run, const std::filesystem::path& truth_file,
                         const std::filesystem::path& landmarks_file = {});

}  // namespace azimuth
