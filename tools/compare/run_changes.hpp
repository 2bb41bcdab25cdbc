#pragma once
// Groups reports by the names of their runs, and compares one run with its baseline. Internal to tools/compare.

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

/// Changes of all figures; `before` may be empty. Trends of repeated seeds ignore that other runs are tested too:
/// settle_repeated() corrects them.
ComparedRun compared_run(const std::string& name, const Repeats& after, const Repeats& before,
                         const CompareSettings& settings);

/// Corrects the trends for multiple testing. Among many runs, some show a large change by chance. Only changes that
/// stay improbable given the number of tests remain `worse` or `better`.
void settle_repeated(std::vector<ComparedRun>& runs, const CompareSettings& settings);

}  // namespace azimuth
