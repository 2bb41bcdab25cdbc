#include <cmath>
#include <fmt/format.h>

#include "tools/compare/comparison.hpp"
#include "tools/compare/words.hpp"

namespace azimuth {
namespace {

using Sentences = std::vector<std::string>;

bool is_past(Trend trend) { return trend == Trend::worse || trend == Trend::gone; }

void judge_run(const ComparedRun& run, const CompareSettings& settings, Sentences& past) {
  for (std::size_t i = 0; i < kFigures; ++i) {
    const Figure& figure = figures()[i];
    const FigureChange& change = run.changes[i];
    if (is_past(change.trend))
      past.push_back(
          fmt::format("{}: {}", run.name, sentence(figure, change.before, change.after, change.change, change.trend)));
    const double worst = settings.limits[i].worst;
    if (badness(figure, change.after) > badness(figure, worst))
      past.push_back(fmt::format("{}: {} {} is worse than {}", run.name, figure.label, value_text(figure, change.after),
                                 value_text(figure, worst)));
  }
}

void judge_group(const ComparedGroup& group, Sentences& past) {
  for (std::size_t i = 0; i < kFigures; ++i) {
    const ComparedGroup::Mean& mean = group.means[i];
    if (mean.trend != Trend::worse) continue;
    past.push_back(fmt::format("{}, on the average of {}: {}", group.tag.empty() ? "all runs" : "tag " + group.tag,
                               counted(mean.change.count, "run"),
                               sentence(figures()[i], mean.before, mean.after, mean.change.mean, mean.trend)));
  }
}

void judge_count(std::size_t count, std::size_t allowed, const std::string& what, Sentences& past) {
  if (count > allowed) past.push_back(fmt::format("{}: {}; {} may be", what, count, allowed));
}

}  // namespace

std::vector<std::string> past_limits(const Comparison& comparison, const CompareSettings& settings) {
  Sentences past;
  judge_count(comparison.missing.size(), settings.missing, "runs missing", past);
  judge_count(comparison.failed.size(), settings.failed, "runs failed", past);
  judge_count(comparison.unreadable.size(), settings.unreadable, "reports that cannot be used", past);
  judge_count(comparison.twice.size(), settings.twice, "runs reported twice", past);
  for (const ComparedRun& run : comparison.runs) judge_run(run, settings, past);
  for (const ComparedGroup& group : comparison.groups) judge_group(group, past);
  return past;
}

}  // namespace azimuth
