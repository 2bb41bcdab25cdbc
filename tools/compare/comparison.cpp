#include "tools/compare/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "tools/compare/group_changes.hpp"
#include "tools/compare/run_changes.hpp"

namespace azimuth {
namespace {

std::vector<std::string> versions_of(const Reports& reports) {
  std::set<std::string> versions;
  for (const RunReport& report : reports.all)
    if (!report.made_by.empty()) versions.insert(report.made_by);
  return {versions.begin(), versions.end()};
}

/// Marks computing times and memory as not measured.
Reports without_costs(Reports reports) {
  for (RunReport& report : reports.all)
    for (std::size_t i = 0; i < kFigures; ++i)
      if (figures()[i].is_cost) report.values[i] = kNoNumber;
  return reports;
}

/// Sort key without a baseline: the least accurate run comes first, runs without truth come last.
double first_figure(const ComparedRun& run) {
  const double value = run.changes.front().after;
  return std::isnan(value) ? -1.0 : value;
}

void sort_runs(Comparison& comparison) {
  std::ranges::stable_sort(comparison.runs, [&](const ComparedRun& a, const ComparedRun& b) {
    if (!comparison.has_baseline) return first_figure(a) > first_figure(b);
    if (a.has(Trend::worse) != b.has(Trend::worse)) return a.has(Trend::worse);
    return a.severity() > b.severity();
  });
}

}  // namespace

std::string_view to_string(Trend trend) {
  switch (trend) {
    case Trend::unmeasured:
      return "unmeasured";
    case Trend::gone:
      return "no longer measured";
    case Trend::equal:
      return "equal";
    case Trend::alike:
      return "alike";
    case Trend::better:
      return "better";
    case Trend::worse:
      return "worse";
    case Trend::unjudged:
      return "not judged";
  }
  return "?";
}

bool ComparedRun::has(Trend trend) const {
  return std::ranges::any_of(changes, [&](const FigureChange& change) { return change.trend == trend; });
}

double ComparedRun::severity() const {
  const auto [least, most] = std::ranges::minmax(changes, {}, &FigureChange::severity);
  return most.severity > 0.0 ? most.severity : least.severity;
}

CompareSettings default_compare_settings() {
  CompareSettings settings;
  for (std::size_t i = 0; i < kFigures; ++i) settings.limits[i] = figures()[i].limits;
  return settings;
}

Comparison compare(const Reports& given, const Reports* given_before, const CompareSettings& settings) {
  const Reports after = settings.with_costs ? given : without_costs(given);
  const Reports before = !given_before ? Reports{} : settings.with_costs ? *given_before : without_costs(*given_before);
  Comparison comparison;
  comparison.has_baseline = given_before != nullptr;
  comparison.made_by = versions_of(after);
  comparison.made_by_before = versions_of(before);
  comparison.unreadable = after.unreadable;
  comparison.unreadable.insert(comparison.unreadable.end(), before.unreadable.begin(), before.unreadable.end());
  const auto now = runs_by_name(after, comparison, comparison.failed);
  const auto then = runs_by_name(before, comparison, comparison.failed_before);
  for (const auto& [name, repeats] : now) {
    const auto found = then.find(name);
    if (comparison.has_baseline && found == then.end()) comparison.added.push_back(name);
    comparison.runs.push_back(compared_run(name, repeats, found == then.end() ? Repeats{} : found->second, settings));
  }
  for (const auto& [name, repeats] : then)
    if (!now.contains(name)) comparison.missing.push_back(name);
  settle_repeated(comparison.runs, settings);
  comparison.groups = compared_groups(comparison.runs, settings);
  sort_runs(comparison);
  return comparison;
}

}  // namespace azimuth
