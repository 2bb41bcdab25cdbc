#pragma once
// Where tests find what is not theirs: the source tree, and the runs that are not shipped.

#include <filesystem>

namespace azimuth::test {

/// The top of the source tree, absolute.
std::filesystem::path source_folder();

/// The folder of real runs: environment variable AZIMUTH_DATA, else ../shared/data beside the source tree. It need not
/// exist.
std::filesystem::path data_folder();

}  // namespace azimuth::test
