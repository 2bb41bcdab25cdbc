#pragma once
// Compares one run with its baseline. Internal to tools/compare.

#include "tools/compare/paired_runs.hpp"

namespace azimuth {

/// Changes of all figures; `before` may be empty. Trends of repeated seeds ignore that other runs are tested too:
/// settle_repeated() corrects them.
ComparedRun compared_run(const std::string& name, const Repeats& after, const Repeats& before,
                         const CompareSettings& settings);

/// Corrects the trends for multiple testing. Among many runs, some show a large change by chance. Only changes that
/// stay improbable given the number of tests remain `worse` or `better`.
void settle_repeated(std::vector<ComparedRun>& runs, const CompareSettings& settings);

}  // namespace azimuth
