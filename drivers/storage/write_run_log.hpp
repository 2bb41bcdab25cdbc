#pragma once
#include <cstddef>
#include <functional>

#include "drivers/storage/run.hpp"

namespace azimuth {

/// Called after each written record. An exception from it ends the writing, and leaves a part of the file.
using WriteProgress = std::function<void(std::size_t done, std::size_t all)>;

/// Like write_run_log() of run.hpp, for runs that take long.
[[nodiscard]] FileResult<void> write_run_log(const Run& run, const std::filesystem::path& file,
                                             const LogOptions& options, const WriteProgress& progress);

}  // namespace azimuth
