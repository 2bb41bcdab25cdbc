#pragma once
// Internal to drivers/storage; see run.hpp.

#include <filesystem>

#include "drivers/storage/run.hpp"

namespace azimuth {

FileResult<Run> read_run_folder(const std::filesystem::path& folder, const LogOptions& options = {});

// The files of a run folder.
inline constexpr const char* kRigFile = "rig.toml";
inline constexpr const char* kOdometryFile = "odometry.csv";
inline constexpr const char* kBearingsFile = "bearings.csv";
inline constexpr const char* kFramesFile = "frames.csv";
inline constexpr const char* kTruthFile = "truth.csv";
inline constexpr const char* kLandmarksFile = "landmarks.csv";

}  // namespace azimuth
