#pragma once
#include <string>

#include "tools/evaluate/report.hpp"

namespace azimuth {

/// The report as one JSON object, indented, with a newline at its end. Whatever was not measured is null.
std::string to_json(const Report& report);

}  // namespace azimuth
