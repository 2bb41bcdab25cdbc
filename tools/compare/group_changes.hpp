#pragma once
// Runs by their tags. Internal to tools/compare.

#include <vector>

#include "tools/compare/comparison.hpp"

namespace azimuth {

/// All of `runs`, then those of each tag.
std::vector<ComparedGroup> compared_groups(const std::vector<ComparedRun>& runs, const CompareSettings& settings);

}  // namespace azimuth
