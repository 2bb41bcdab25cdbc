#pragma once
#include "drivers/storage/recorded_outputs.hpp"
#include "tools/export/estimated.hpp"

namespace azimuth {

/// What a daemon estimated, as it published it.
Estimated estimated_of(const RecordedOutputs& outputs, std::string run);

}  // namespace azimuth
