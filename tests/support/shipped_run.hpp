#pragma once
// The run that ships with Azimuth.

#include <filesystem>

namespace azimuth::test {

/// runs/lab, absolute.
std::filesystem::path shipped_run();

/// Writes the first of its three laps to `folder`, which it makes: for those who look at no numbers.
void copy_one_lap(const std::filesystem::path& folder);

}  // namespace azimuth::test
