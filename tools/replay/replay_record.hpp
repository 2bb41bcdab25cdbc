#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/storage/run.hpp"
#include "slam/estimator/rig.hpp"
#include "tools/evaluate/report.hpp"
#include "tools/replay/replay.hpp"

namespace azimuth {

/// Combines a run and its replay for evaluate(). `estimator` is the configured name.
ReplayRecord replay_record(const Run& run, const Rig& rig, const std::string& estimator, std::uint64_t seed,
                           const ReplayResult& result);

// Names of front ends as in rig.toml.
std::string front_end_name(FrontEnd front_end);
std::optional<FrontEnd> front_end_named(std::string_view name);
std::vector<std::string> front_end_names();

/// Peak memory of this process, in megabytes of 10^6 bytes.
double peak_memory_mb();

/// Present memory of this process, in megabytes of 10^6 bytes; NaN if the kernel does not report it.
double resident_memory_mb();

}  // namespace azimuth
