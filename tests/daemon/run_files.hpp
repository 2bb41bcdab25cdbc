#pragma once
// Writes the small run to disk as a run folder.

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>

#include "drivers/storage/run.hpp"
#include "tests/daemon/small_run.hpp"

namespace azimuth::test {

inline constexpr Identity kHangingIdentity = 666;

/// Writes the recording with the small rig and returns the folder.
inline std::filesystem::path write_run(const Recording& recording, const std::filesystem::path& folder) {
  Run run;
  run.rig_toml = kSmallRig;
  run.odometry = recording.odometry;
  run.bearings = recording.bearings;
  const auto written = write_run_folder(run, folder);
  EXPECT_TRUE(written) << text(written.error());
  return folder;
}

inline void write_text(const std::filesystem::path& file, const std::string& text) { std::ofstream(file) << text; }

inline std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace azimuth::test
