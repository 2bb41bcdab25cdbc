#include "tools/compare/compare_json.hpp"

#include <cmath>

#include "tools/page/html_page.hpp"

namespace azimuth {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string_view better_word(Better better) {
  switch (better) {
    case Better::lower:
      return "lower";
    case Better::higher:
      return "higher";
    case Better::nearer_to_three:
      return "nearer_to_three";
  }
  return "?";
}

Json figure_json(const Figure& figure, const FigureLimits& limits) {
  return {{"key", figure.key},
          {"label", figure.label},
          {"unit", figure.unit},
          {"shown_factor", figure.shown_factor},
          {"decimals", figure.decimals},
          {"better", better_word(figure.better)},
          {"by_ratio", figure.by_ratio},
          {"limits",
           {{"relative", number(limits.relative)},
            {"absolute", number(limits.absolute)},
            {"good_enough", number(limits.good_enough)},
            {"mean", number(limits.mean)},
            {"worst", number(limits.worst)}}}};
}

Json change_json(const FigureChange& change) {
  return {{"before", number(change.before)},
          {"after", number(change.after)},
          {"change", number(change.change)},
          {"chance", number(change.chance)},
          {"trend", to_string(change.trend)}};
}

/// Contains only figures that were measured.
Json run_json(const ComparedRun& run) {
  Json changes = Json::object();
  for (std::size_t i = 0; i < kFigures; ++i)
    if (run.changes[i].trend != Trend::unmeasured || std::isfinite(run.changes[i].after))
      changes[std::string(figures()[i].key)] = change_json(run.changes[i]);
  return {{"name", run.name},
          {"tags", run.tags},
          {"seeds", run.seeds},
          {"seeds_before", run.seeds_before},
          {"digest", run.digest},
          {"digest_before", run.digest_before},
          {"figures", std::move(changes)}};
}

Json mean_json(const ComparedGroup::Mean& mean) {
  return {{"before", number(mean.before)},  {"after", number(mean.after)},      {"change", number(mean.change.mean)},
          {"low", number(mean.change.low)}, {"high", number(mean.change.high)}, {"pairs", mean.change.count},
          {"trend", to_string(mean.trend)}};
}

Json group_json(const ComparedGroup& group) {
  Json means = Json::object();
  for (std::size_t i = 0; i < kFigures; ++i)
    if (std::isfinite(group.means[i].after)) means[std::string(figures()[i].key)] = mean_json(group.means[i]);
  return {{"tag", group.tag.empty() ? Json(nullptr) : Json(group.tag)},
          {"runs", group.runs},
          {"figures", std::move(means)}};
}

Json failed_json(const std::vector<FailedRun>& failed) {
  Json all = Json::array();
  for (const FailedRun& run : failed) all.push_back({{"name", run.name}, {"why", run.why}});
  return all;
}

Json absent_json(const Comparison& comparison) {
  Json twice = Json::array(), unreadable = Json::array();
  for (const TwiceReported& each : comparison.twice)
    twice.push_back({{"name", each.name}, {"used", each.used}, {"left_out", each.left_out}});
  for (const FileError& error : comparison.unreadable)
    unreadable.push_back({{"file", error.file}, {"why", error.message}});
  return {{"missing", comparison.missing},
          {"new", comparison.added},
          {"failed", failed_json(comparison.failed)},
          {"failed_before", failed_json(comparison.failed_before)},
          {"incomplete", failed_json(comparison.incomplete)},
          {"unreadable", std::move(unreadable)},
          {"twice", std::move(twice)},
          {"older", comparison.older}};
}

}  // namespace

Json comparison_json(const Comparison& comparison, const CompareSettings& settings,
                     const std::vector<std::string>& past, std::string_view made_by) {
  Json figures_json = Json::array(), runs = Json::array(), groups = Json::array();
  for (std::size_t i = 0; i < kFigures; ++i) figures_json.push_back(figure_json(figures()[i], settings.limits[i]));
  for (const ComparedRun& run : comparison.runs) runs.push_back(run_json(run));
  for (const ComparedGroup& group : comparison.groups) groups.push_back(group_json(group));
  return {{"made_by", made_by},
          {"baseline", comparison.has_baseline},
          {"versions", comparison.made_by},
          {"versions_before", comparison.made_by_before},
          {"figures", std::move(figures_json)},
          {"past_limits", past},
          {"absent", absent_json(comparison)},
          {"groups", std::move(groups)},
          {"runs", std::move(runs)}};
}

std::string json_text(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string comparison_page(const Json& comparison) {
  return html_page("Azimuth: runs compared", json_text(comparison, -1), "compare.js");
}

}  // namespace azimuth
