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

/// Puts a run and what was made of it side by side for evaluate(). `estimator` is the configured name.
ReplayRecord replay_record(const Run& run, const Rig& rig, const std::string& estimator, std::uint64_t seed,
                           const ReplayResult& result);

// The words rig.toml uses.
std::string front_end_name(FrontEnd front_end);
std::optional<FrontEnd> front_end_named(std::string_view name);
std::vector<std::string> front_end_names();

/// Most memory this process has had so far, in megabytes of 10^6 bytes.
double peak_memory_mb();

/// Memory of this process now, in 10^6 bytes; not a number where the kernel does not say.
double resident_memory_mb();

}  // namespace azimuth
