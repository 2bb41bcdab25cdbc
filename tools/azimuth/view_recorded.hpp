#pragma once
#include <string>

#include "tools/azimuth/view_options.hpp"

namespace azimuth {

/// What the page of the recordings shows, as JSON. Refuses what cannot be read, and a run of which nothing comes.
std::string recorded_page(const ViewOptions& options);

}  // namespace azimuth
