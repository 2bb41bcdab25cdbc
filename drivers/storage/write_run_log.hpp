#pragma once
#include <cstddef>
#include <functional>

#include "drivers/storage/run.hpp"

namespace azimuth {

/// Told of each record that was written; what it throws ends the writing, with a part of the file there.
using WriteProgress = std::function<void(std::size_t done, std::size_t all)>;

/// As write_run_log() of run.hpp, for runs that take long.
[[nodiscard]] FileResult<void> write_run_log(const Run& run, const std::filesystem::path& file,
                                             const LogOptions& options, const WriteProgress& progress);

}  // namespace azimuth
