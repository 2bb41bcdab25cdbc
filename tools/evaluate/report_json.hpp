#pragma once
#include <string>

#include "tools/evaluate/report.hpp"

namespace azimuth {

/// The report as one indented JSON object with a final newline. Values that were not measured are null.
std::string to_json(const Report& report);

}  // namespace azimuth
