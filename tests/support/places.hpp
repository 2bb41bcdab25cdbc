#pragma once
// Folders that tests read from: the source tree, and the runs that are not shipped.

#include <filesystem>

namespace azimuth::test {

/// Top folder of the source tree, absolute.
std::filesystem::path source_folder();

/// Folder of the real runs: environment variable AZIMUTH_DATA if set, else ../shared/data beside the source tree. The
/// folder may be missing.
std::filesystem::path data_folder();

}  // namespace azimuth::test
