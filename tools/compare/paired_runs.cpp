#include "tools/compare/paired_runs.hpp"

#include <algorithm>
#include <cmath>

namespace azimuth {
namespace {

/// Adds a report. If the seed is already present, the first report stays.
void add(const RunReport& report, Repeats& repeats, Comparison& comparison) {
  const auto same = std::ranges::find(repeats, report.seed, &RunReport::seed);
  if (same != repeats.end())
    comparison.twice.push_back({report.name, (*same)->file, report.file});
  else
    repeats.push_back(&report);
}

/// Adds each run once, since its other seeds, and usually the baseline, replay the same log.
void add_incomplete(const RunReport& report, std::vector<FailedRun>& incomplete) {
  if (report.incomplete.empty() || std::ranges::find(incomplete, report.name, &FailedRun::name) != incomplete.end())
    return;
  incomplete.push_back({report.name, report.incomplete});
}

}  // namespace

std::map<std::string, Repeats> runs_by_name(const Reports& reports, Comparison& comparison,
                                            std::vector<FailedRun>& failed) {
  std::map<std::string, Repeats> runs;
  for (const RunReport& report : reports.all) {
    if (report.is_older) comparison.older.push_back(report.file);
    add_incomplete(report, comparison.incomplete);
    if (report.failure.empty())
      add(report, runs[report.name], comparison);
    else
      failed.push_back({report.name, report.failure});
  }
  for (auto& [name, repeats] : runs) std::ranges::sort(repeats, {}, &RunReport::seed);
  return runs;
}

std::vector<double> badnesses(const Repeats& repeats, std::size_t figure) {
  std::vector<double> all;
  for (const RunReport* report : repeats) {
    const double value = badness(figures()[figure], report->values[figure]);
    if (std::isfinite(value)) all.push_back(value);
  }
  return all;
}

double mean_value(const Repeats& repeats, std::size_t figure) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const RunReport* report : repeats) {
    if (!std::isfinite(report->values[figure])) continue;
    sum += report->values[figure];
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : kNoNumber;
}

}  // namespace azimuth
