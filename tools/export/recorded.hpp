#pragma once
#include "drivers/storage/recorded_outputs.hpp"
#include "tools/export/estimated.hpp"

namespace azimuth {

/// The estimates that a daemon published.
Estimated estimated_of(const RecordedOutputs& outputs, std::string run);

}  // namespace azimuth
