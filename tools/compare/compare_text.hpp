#pragma once
#include <string>

#include "tools/compare/comparison.hpp"

namespace azimuth {

/// A plain table: what is missing, then the averages by tag, then run by run, what got worse first.
std::string comparison_text(const Comparison& comparison);

}  // namespace azimuth
