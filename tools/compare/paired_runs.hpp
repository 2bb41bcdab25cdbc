#pragma once
// Reports sorted by the names of their runs. Internal to tools/compare.

#include <map>
#include <string>
#include <vector>

#include "tools/compare/comparison.hpp"

namespace azimuth {

/// Reports of one run, of different seeds, in their order.
using Repeats = std::vector<const RunReport*>;

/// The runs of one side. Failures, repetitions and older ones are told in `comparison`.
std::map<std::string, Repeats> runs_by_name(const Reports& reports, Comparison& comparison,
                                            std::vector<FailedRun>& failed);

/// Badness of one figure in each that has it.
std::vector<double> badnesses(const Repeats& repeats, std::size_t figure);

/// Mean of its values; not a number: none has it.
double mean_value(const Repeats& repeats, std::size_t figure);

}  // namespace azimuth
