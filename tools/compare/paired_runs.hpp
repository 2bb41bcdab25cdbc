#pragma once
// Groups reports by the names of their runs. Internal to tools/compare.

#include <map>
#include <string>
#include <vector>

#include "tools/compare/comparison.hpp"

namespace azimuth {

/// Reports of one run with different seeds, in ascending order of seeds.
using Repeats = std::vector<const RunReport*>;

/// The runs of one side. Failed runs go to `failed`; `comparison` records duplicates and reports in an older format.
std::map<std::string, Repeats> runs_by_name(const Reports& reports, Comparison& comparison,
                                            std::vector<FailedRun>& failed);

/// Badness of one figure in each report that contains it.
std::vector<double> badnesses(const Repeats& repeats, std::size_t figure);

/// Mean of the figure's values; NaN if no report contains it.
double mean_value(const Repeats& repeats, std::size_t figure);

}  // namespace azimuth
