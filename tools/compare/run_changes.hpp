#pragma once
// One run now and before. Internal to tools/compare.

#include "tools/compare/paired_runs.hpp"

namespace azimuth {

/// Changes of every figure; `before` may be empty. Trends as if it were the only run that is tested with repeated
/// seeds: see settle_repeated().
ComparedRun compared_run(const std::string& name, const Repeats& after, const Repeats& before,
                         const CompareSettings& settings);

/// Among many runs some scatter far by chance alone: only what their number leaves improbable stays worse or better.
void settle_repeated(std::vector<ComparedRun>& runs, const CompareSettings& settings);

}  // namespace azimuth
