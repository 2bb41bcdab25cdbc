#include "tools/compare/run_changes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// Badness of one figure in each report that contains it.
std::vector<double> badnesses(const Repeats& repeats, std::size_t figure) {
  std::vector<double> all;
  for (const RunReport* report : repeats) {
    const double value = badness(figures()[figure], report->values[figure]);
    if (std::isfinite(value)) all.push_back(value);
  }
  return all;
}

/// Mean of the figure's values; NaN if no report contains it.
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

std::vector<std::uint64_t> seeds_of(const Repeats& repeats) {
  std::vector<std::uint64_t> seeds;
  for (const RunReport* report : repeats) seeds.push_back(report->seed);
  return seeds;
}

/// Ratio of the growth from `low` to `high` to the allowed growth. A ratio of at most 1 is within the limits.
double excess(const FigureLimits& limits, double low, double high) {
  const double allowed = std::max(limits.relative * low, limits.absolute);
  if (high <= limits.good_enough || std::isnan(allowed)) return 0.0;
  if (!(high - low > 0.0)) return 0.0;
  return allowed > 0.0 ? (high - low) / allowed : std::numeric_limits<double>::infinity();
}

/// Tolerance for rounding errors at the limit.
constexpr double kJustAllowed = 1.0 + 1e-9;

class Judge {
 public:
  Judge(const Repeats& after, const Repeats& before, const CompareSettings& settings)
      : after_(after), before_(before), settings_(settings), same_seeds_(seeds_of(after) == seeds_of(before)) {}

  FigureChange change(std::size_t figure) const {
    FigureChange change{
        mean_value(before_, figure), mean_value(after_, figure), kNoNumber, kNoNumber, Trend::unmeasured, 0.0};
    const std::vector<double> now = badnesses(after_, figure), then = badnesses(before_, figure);
    if (now.empty() || then.empty()) {
      if (!then.empty()) change.trend = Trend::gone;
      return change;
    }
    const Spread mean_now = spread(now), mean_then = spread(then);
    change.change = change_of(figures()[figure], mean_then.mean, mean_now.mean);
    if (now == then && change.before == change.after) {
      change.trend = Trend::equal;
      return change;
    }
    judge(settings_.limits[figure], mean_then, mean_now, change);
    return change;
  }

 private:
  void judge(const FigureLimits& limits, const Spread& then, const Spread& now, FigureChange& change) const {
    const double worse = excess(limits, then.mean, now.mean), better = excess(limits, now.mean, then.mean);
    change.severity = worse > 0.0 ? worse : -better;
    if (std::isfinite(limits.relative))
      change.chance = now.mean >= then.mean ? chance_of_rise(then, now) : chance_of_rise(now, then);
    change.trend = worse > kJustAllowed ? Trend::worse : better > kJustAllowed ? Trend::better : Trend::alike;
    if (change.trend != Trend::alike && std::isnan(change.chance) && !same_seeds_) change.trend = Trend::unjudged;
  }

  const Repeats& after_;
  const Repeats& before_;
  const CompareSettings& settings_;
  bool same_seeds_;
};

std::vector<std::string> tags_of(const Repeats& repeats) {
  std::vector<std::string> tags;
  for (const RunReport* report : repeats)
    for (const std::string& tag : report->tags)
      if (std::ranges::find(tags, tag) == tags.end()) tags.push_back(tag);
  std::ranges::sort(tags);
  return tags;
}

template <class Do>
void for_each_tested(std::vector<ComparedRun>& runs, Do&& act) {
  for (ComparedRun& run : runs)
    for (FigureChange& change : run.changes)
      if (!std::isnan(change.chance)) act(change);
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

ComparedRun compared_run(const std::string& name, const Repeats& after, const Repeats& before,
                         const CompareSettings& settings) {
  ComparedRun run{.name = name,
                  .tags = tags_of(after),
                  .seeds = seeds_of(after),
                  .seeds_before = seeds_of(before),
                  .digest = after.front()->digest,
                  .digest_before = before.empty() ? "" : before.front()->digest,
                  .changes = {}};
  const Judge judge(after, before, settings);
  for (std::size_t i = 0; i < kFigures; ++i) run.changes[i] = judge.change(i);
  return run;
}

void settle_repeated(std::vector<ComparedRun>& runs, const CompareSettings& settings) {
  std::size_t tested = 0;
  for_each_tested(runs, [&](const FigureChange&) { ++tested; });
  const double chance = settings.chance_of_false_alarm / static_cast<double>(std::max<std::size_t>(1, tested));
  for_each_tested(runs, [&](FigureChange& change) {
    if (change.chance < chance) return;
    if (change.trend == Trend::worse || change.trend == Trend::better) change.trend = Trend::alike;
    change.severity = std::clamp(change.severity, -1.0, 1.0);
  });
}

}  // namespace azimuth
