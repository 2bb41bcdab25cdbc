#include "tools/compare/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <set>

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

/// Least number of runs for which a mean change is judged.
constexpr std::size_t kFewestToJudge = 6;

using Members = std::vector<const ComparedRun*>;

double mean(const std::vector<double>& values) { return spread(values).mean; }

/// Transforms a change for averaging: ratios are averaged as logarithms.
double measure(const Figure& figure, double change) { return figure.by_ratio ? std::log1p(change) : change; }
double unmeasure(const Figure& figure, double value) { return figure.by_ratio ? std::expm1(value) : value; }

/// Changes of one figure and the values from which they result.
struct Pairs {
  std::vector<double> changes, before, after, alone;  ///< `alone`: new values of all runs, with or without a baseline
};

Pairs pairs_of(const Members& members, std::size_t figure) {
  Pairs pairs;
  for (const ComparedRun* run : members) {
    const FigureChange& change = run->changes[figure];
    if (std::isfinite(change.after)) pairs.alone.push_back(change.after);
    const double measured = measure(figures()[figure], change.change);
    if (!std::isfinite(measured)) continue;
    pairs.changes.push_back(measured);
    pairs.before.push_back(change.before);
    pairs.after.push_back(change.after);
  }
  return pairs;
}

/// One-sided p-value of Student's t-test for a mean above 0.
double chance_of_mean(const std::vector<double>& changes) {
  const Spread all = spread(changes);
  const double error = std::sqrt(all.variance / static_cast<double>(all.count));
  if (error == 0.0) return all.mean > 0.0 ? 0.0 : 1.0;
  return student_tail(all.mean / error, static_cast<double>(all.count - 1));
}

Trend trend_of(std::vector<double> changes, double change, const FigureLimits& limits, double chance) {
  if (changes.size() < kFewestToJudge) return Trend::unmeasured;
  if (std::ranges::all_of(changes, [](double each) { return each == 0.0; })) return Trend::equal;
  if (std::abs(change) <= limits.mean) return Trend::alike;
  if (change < 0.0)
    for (double& each : changes) each = -each;
  if (!(chance_of_mean(changes) < chance)) return Trend::alike;
  return change > 0.0 ? Trend::worse : Trend::better;
}

ComparedGroup::Mean mean_of(const Members& members, std::size_t i, const CompareSettings& settings, double chance) {
  const Figure& figure = figures()[i];
  const Pairs pairs = pairs_of(members, i);
  MeanInterval change = bootstrap_mean(pairs.changes);
  for (double* value : {&change.mean, &change.low, &change.high}) *value = unmeasure(figure, *value);
  const Trend trend = trend_of(pairs.changes, change.mean, settings.limits[i], chance);
  const bool paired = !pairs.changes.empty();
  return {mean(pairs.before), mean(paired ? pairs.after : pairs.alone), change, trend};
}

ComparedGroup group_of(const std::string& tag, const Members& members, const CompareSettings& settings, double chance) {
  ComparedGroup group;
  group.tag = tag;
  group.runs = members.size();
  for (std::size_t i = 0; i < kFigures; ++i) group.means[i] = mean_of(members, i, settings, chance);
  return group;
}

Members with_tag(const std::vector<ComparedRun>& runs, const std::string* tag) {
  Members members;
  for (const ComparedRun& run : runs)
    if (!tag || std::ranges::find(run.tags, *tag) != run.tags.end()) members.push_back(&run);
  return members;
}

/// The group of all runs, then one group for each tag.
std::vector<ComparedGroup> compared_groups(const std::vector<ComparedRun>& runs, const CompareSettings& settings) {
  std::set<std::string> tags;
  for (const ComparedRun& run : runs) tags.insert(run.tags.begin(), run.tags.end());
  const double chance = settings.chance_of_false_alarm / static_cast<double>(kFigures * (tags.size() + 1));
  std::vector<ComparedGroup> groups{group_of("", with_tag(runs, nullptr), settings, chance)};
  for (const std::string& tag : tags) groups.push_back(group_of(tag, with_tag(runs, &tag), settings, chance));
  return groups;
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
