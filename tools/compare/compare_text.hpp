#pragma once
#include <string>

#include "tools/compare/comparison.hpp"

namespace azimuth {

/// A plain text table: missing runs, then averages by tag, then each run, the worst first.
std::string comparison_text(const Comparison& comparison);

}  // namespace azimuth
