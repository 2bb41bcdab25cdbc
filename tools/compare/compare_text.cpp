#include "tools/compare/compare_text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace azimuth {
namespace {

std::string with_unit(std::string number, const Figure& figure) {
  return figure.unit.empty() ? number : fmt::format("{} {}", number, figure.unit);
}

std::string size_text(const Figure& figure, double change) {
  if (figure.by_ratio) return fmt::format("{:.1f} %", 100.0 * std::abs(change));
  const double shown = figure.shown_factor * std::abs(change);
  return with_unit(fmt::format("{:.{}f}", shown, figure.decimals), figure);
}

std::string line(const std::string& topic, const std::string& words) { return fmt::format("{:<12}{}\n", topic, words); }

std::size_t count_of(const Comparison& comparison, Trend trend) {
  return static_cast<std::size_t>(
      std::ranges::count_if(comparison.runs, [&](const ComparedRun& run) { return run.has(trend); }));
}

std::string joined_words(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string head(const Comparison& comparison) {
  std::string words = counted(comparison.runs.size(), "run");
  if (comparison.has_baseline)
    words += fmt::format(": {} worse, {} better, {} new, {} missing", count_of(comparison, Trend::worse),
                         count_of(comparison, Trend::better), comparison.added.size(), comparison.missing.size());
  std::string text = line("compared", words);
  if (!comparison.made_by.empty()) text += line("made by", joined_words(comparison.made_by));
  if (!comparison.made_by_before.empty()) text += line("baseline by", joined_words(comparison.made_by_before));
  return text;
}

/// Runs that are not in the tables, each with its name and the reason.
std::string absent(const Comparison& comparison) {
  std::string text;
  for (const std::string& name : comparison.missing) text += line("missing", name);
  for (const std::string& name : comparison.added) text += line("new", name);
  for (const FailedRun& run : comparison.failed) text += line("failed", run.name + ": " + run.why);
  for (const FailedRun& run : comparison.failed_before)
    text += line("failed", run.name + ", of the baseline: " + run.why);
  for (const FailedRun& run : comparison.incomplete) text += line("incomplete", run.name + ": " + run.why);
  for (const FileError& error : comparison.unreadable) text += line("unreadable", error.text());
  for (const TwiceReported& twice : comparison.twice)
    text += line("twice", fmt::format("{}: {} left out, {} used", twice.name, twice.left_out, twice.used));
  if (!comparison.older.empty())
    text += line("older", fmt::format("{} without name and tags, the first {}",
                                      counted(comparison.older.size(), "report"), comparison.older.front()));
  return text;
}

std::string mean_words(const Figure& figure, const ComparedGroup::Mean& mean, bool has_baseline) {
  std::string text = fmt::format("{:<16}{:>12}", figure.label, value_text(figure, mean.after));
  if (!has_baseline || mean.change.count == 0) return text;
  text += fmt::format("  was {:>12}  {:>9}", value_text(figure, mean.before), change_text(figure, mean.change.mean));
  if (std::isfinite(mean.change.low))
    text += fmt::format(" [{}, {}]", change_text(figure, mean.change.low), change_text(figure, mean.change.high));
  if (mean.trend == Trend::worse || mean.trend == Trend::better) text += fmt::format("  {}", to_string(mean.trend));
  return text;
}

std::string group_text(const ComparedGroup& group, bool has_baseline) {
  std::string text =
      "\n" + (group.tag.empty() ? std::string("all") : "tag " + group.tag) + ", " + counted(group.runs, "run") + "\n";
  for (std::size_t i = 0; i < kFigures; ++i)
    if (std::isfinite(group.means[i].after))
      text += "  " + mean_words(figures()[i], group.means[i], has_baseline) + "\n";
  return text;
}

/// Notes on further figures of a run whose trend matters.
std::string run_notes(const ComparedRun& run) {
  std::string text;
  for (const Trend trend : {Trend::worse, Trend::gone, Trend::unjudged, Trend::better})
    for (std::size_t i = 0; i < kFigures; ++i) {
      const FigureChange& change = run.changes[i];
      if (change.trend != trend) continue;
      text += fmt::format("    {:<8}{}\n", trend == Trend::worse ? "WORSE" : "",
                          sentence(figures()[i], change.before, change.after, change.change, trend));
    }
  return text;
}

std::string runs_text(const Comparison& comparison) {
  std::size_t longest = 4;
  for (const ComparedRun& run : comparison.runs) longest = std::max(longest, run.name.size());
  constexpr std::array<std::size_t, 4> kShown{0, 3, 4, 7};  // position, ANEES, tracking, map
  std::string text = fmt::format("\n{:<{}}", "run", longest);
  for (const std::size_t i : kShown) text += fmt::format("{:>16}", figures()[i].label);
  text += comparison.has_baseline ? "        position\n" : "\n";
  for (const ComparedRun& run : comparison.runs) {
    text += fmt::format("{:<{}}", run.name, longest);
    for (const std::size_t i : kShown) text += fmt::format("{:>16}", value_text(figures()[i], run.changes[i].after));
    const double change = run.changes.front().change;
    text += comparison.has_baseline ? fmt::format("{:>16}\n", change_text(figures()[0], change)) : "\n";
    text += run_notes(run);
  }
  return text;
}

}  // namespace

std::string value_text(const Figure& figure, double value) {
  if (!std::isfinite(value)) return "-";
  return with_unit(fmt::format("{:.{}f}", figure.shown_factor * value, figure.decimals), figure);
}

std::string change_text(const Figure& figure, double change) {
  if (std::isnan(change)) return "-";
  return (change < 0.0 ? "-" : "+") + size_text(figure, change);
}

std::string sentence(const Figure& figure, double before, double after, double change, Trend trend) {
  std::string text = fmt::format("{} {}, was {}", figure.label, value_text(figure, after), value_text(figure, before));
  if (trend == Trend::gone) return text + ": no longer measured";
  if (trend != Trend::worse && trend != Trend::better) return text + ": " + std::string(to_string(trend));
  if (std::isnan(change)) return text + ": " + std::string(to_string(trend));
  return fmt::format("{}: {} by {}", text, to_string(trend), size_text(figure, change));
}

std::string counted(std::size_t count, const std::string& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string comparison_text(const Comparison& comparison) {
  std::string text = head(comparison) + absent(comparison);
  for (const ComparedGroup& group : comparison.groups)
    if (group.runs > 0) text += group_text(group, comparison.has_baseline);
  return text + (comparison.runs.empty() ? "" : runs_text(comparison));
}

}  // namespace azimuth
