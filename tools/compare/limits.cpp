#include <fmt/format.h>
#include <vector>

#include "settings/reader.hpp"
#include "tools/compare/compare_text.hpp"
#include "tools/compare/comparison.hpp"

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

constexpr double kMost = 1e9;

/// The counts of the table [reports].
struct Allowed {
  int missing = 0, failed = 0, unreadable = 0, twice = 0;
};

Section top_section(CompareSettings& settings) {
  return {"",
          "",
          {{"chance_of_false_alarm", &settings.chance_of_false_alarm,
            "That any run is called worse though nothing but seeds differs.", above_to(0, 0.5)}}};
}

Section reports_section(Allowed& allowed) {
  return {"reports",
          "Of reports, so many may be",
          {{"missing", &allowed.missing, "in the baseline alone.", from_to(0, kMost)},
           {"failed", &allowed.failed, "of runs of which nothing came.", from_to(0, kMost)},
           {"unreadable", &allowed.unreadable, "cut or no reports.", from_to(0, kMost)},
           {"twice", &allowed.twice, "of a name and seed that another one has.", from_to(0, kMost)}}};
}

Section figure_section(const Figure& figure, FigureLimits& limits) {
  return {figure.key,
          figure.label,
          {{"relative", &limits.relative, "A run may grow worse by this part.", from_to(0, kMost)},
           {"absolute", &limits.absolute, "And by this.", from_to(0, kMost)},
           {"good_enough", &limits.good_enough, "What is no worse than this is no trouble.", from_to(0, kMost)},
           {"mean", &limits.mean, "The average of runs may grow worse by this.", from_to(0, kMost)},
           {"worst", &limits.worst, "No run may be worse than this.", from_to(0, kMost)}}};
}

}  // namespace

FileResult<CompareSettings> read_limits(std::string_view text, const std::string& file) {
  CompareSettings settings = default_compare_settings();
  Allowed allowed;
  std::vector<Section> sections{top_section(settings), reports_section(allowed)};
  for (std::size_t i = 0; i < kFigures; ++i) sections.push_back(figure_section(figures()[i], settings.limits[i]));
  const std::vector<Section*> tables = pointers(sections);
  if (FileErrors errors = read_toml(text, file, tables); !errors.empty()) return failure(std::move(errors));
  settings.missing = static_cast<std::size_t>(allowed.missing);
  settings.failed = static_cast<std::size_t>(allowed.failed);
  settings.unreadable = static_cast<std::size_t>(allowed.unreadable);
  settings.twice = static_cast<std::size_t>(allowed.twice);
  return settings;
}

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
