#pragma once
// The run that is shipped with Azimuth.

#include <filesystem>

namespace azimuth::test {

/// Absolute path of runs/lab.
std::filesystem::path shipped_run();

/// Writes the first of its three laps to `folder`, which is created; for tests that do not check numbers.
void copy_one_lap(const std::filesystem::path& folder);

}  // namespace azimuth::test
