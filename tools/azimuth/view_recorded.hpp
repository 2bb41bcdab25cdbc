#pragma once
#include <string>

#include "tools/azimuth/view_options.hpp"

namespace azimuth {

/// Returns the data of the page of the recordings, as JSON. Refuses recordings that cannot be read, and runs without a
/// step.
std::string recorded_page(const ViewOptions& options);

}  // namespace azimuth
