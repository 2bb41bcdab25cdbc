#pragma once
// Groups runs by tag. Internal to tools/compare.

#include <vector>

#include "tools/compare/comparison.hpp"

namespace azimuth {

/// The group of all runs, then one group for each tag.
std::vector<ComparedGroup> compared_groups(const std::vector<ComparedRun>& runs, const CompareSettings& settings);

}  // namespace azimuth
