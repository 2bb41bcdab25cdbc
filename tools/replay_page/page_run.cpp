#include "tools/replay_page/page_run.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "tools/evaluate/chi2.hpp"
#include "tools/page/base64.hpp"
#include "tools/page/html_page.hpp"
#include "tools/page/thinning.hpp"
#include "tools/replay/replay_picture.hpp"
#include "tools/replay_page/page_map.hpp"
#include "tools/replay_page/page_metrics.hpp"
#include "tools/replay_page/page_series.hpp"

namespace azimuth {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMillisecond = 1e-3;

std::vector<std::size_t> shown(const std::vector<PageColumn>& columns, std::size_t most) {
  std::vector<std::span<const double>> peaks;
  for (const PageColumn& column : columns)
    if (column.keeps_peaks) peaks.emplace_back(column.values);
  return thinned(columns.front().values.size(), peaks, most);
}

Json series(const std::vector<PageColumn>& columns, std::size_t most) {
  const std::vector<std::size_t> rows = shown(columns, most);
  Json json = Json::object();
  json["step"] = rows;
  for (const PageColumn& column : columns) {
    Json& values = json[std::string(column.name)] = Json::array();
    for (const std::size_t row : rows) values.push_back(page_number(column.values[row], column.unit));
  }
  return json;
}

Json metrics(const Report& report) {
  constexpr std::array<std::string_view, 4> kBetter{"neither", "lower", "higher", "nearer_to_three"};
  Json json = Json::array();
  for (const PageMetric& metric : page_metrics(report))
    json.push_back({{"key", metric.key},
                    {"label", metric.label},
                    {"unit", metric.unit},
                    {"value", page_number(metric.value)},
                    {"decimals", metric.decimals},
                    {"better", kBetter.at(static_cast<std::size_t>(metric.better))},
                    {"note", metric.note}});
  return json;
}

Json healths(std::span<const StepHealth> steps) {
  Json json = Json::array();
  for (const HealthStretch& stretch : health_stretches(steps, kMostHealthStretches))
    json.push_back({{"from", page_number(stretch.from_s, kMillisecond)},
                    {"to", page_number(stretch.to_s, kMillisecond)},
                    {"health", to_string(stretch.health)},
                    {"reason", stretch.reason}});
  return json;
}

Json pictures(std::span<const PagePicture> pictures, Stamp first) {
  Json json = Json::array();
  for (const PagePicture& picture : pictures)
    json.push_back({{"t", page_number(to_seconds(picture.stamp - first), kMillisecond)},
                    {"why", picture.why},
                    {"src", "data:image/jpeg;base64," + base64(picture.jpeg)}});
  return json;
}

/// The stretch with the worse health; if both are equal, the longer one.
const HealthStretch& leading(const HealthStretch& a, const HealthStretch& b) {
  const auto badness = [](Health health) { return health == Health::tracking ? -1 : static_cast<int>(health); };
  if (a.health != b.health) return badness(a.health) > badness(b.health) ? a : b;
  return a.to_s - a.from_s >= b.to_s - b.from_s ? a : b;
}

std::vector<HealthStretch> put_together(const std::vector<HealthStretch>& stretches, std::size_t most) {
  const double begin_s = stretches.front().from_s,
               slot_s = (stretches.back().to_s - begin_s) / static_cast<double>(most - 1);
  std::vector<HealthStretch> fewer;
  double slot_end_s = begin_s;
  for (const HealthStretch& stretch : stretches) {
    if (fewer.empty() || stretch.from_s >= slot_end_s) {
      fewer.push_back(stretch);
      while (slot_end_s <= stretch.from_s) slot_end_s += slot_s;
      continue;
    }
    HealthStretch& last = fewer.back();
    const HealthStretch& leads = leading(last, stretch);
    last = {last.from_s, stretch.to_s, leads.health, leads.reason};
  }
  return fewer;
}

/// Text for the user on the unreadable part of the recording; empty if there is none. Events of other programs do not
/// count.
std::string unread(Skipped skipped) {
  skipped.foreign_events = 0;
  const std::string what = skipped.text();
  if (what.empty()) return "";
  return (skipped.damaged_bytes > 0 ? "the recording was cut off, or is damaged: "
                                    : "not all of the recording is shown: ") +
         what;
}

}  // namespace

std::vector<HealthStretch> health_stretches(std::span<const StepHealth> steps, std::size_t most) {
  std::vector<HealthStretch> stretches;
  for (const StepHealth& step : steps) {
    const double now_s = to_seconds(step.stamp - steps.front().stamp);
    if (!stretches.empty()) stretches.back().to_s = now_s;
    if (stretches.empty() || stretches.back().health != step.health || stretches.back().reason != step.reason)
      stretches.push_back({now_s, now_s, step.health, step.reason});
  }
  return stretches.size() > most ? put_together(stretches, most) : stretches;
}

Json page_run(const PageSource& source, std::size_t runs) {
  const Report& report = source.report;
  const ReplayResult& result = source.result;
  const Stamp first = result.estimates.front().stamp;
  const std::vector<PageColumn> columns = page_series(source.run, result, report, source.steps);
  Json json;
  json["name"] = report.run;
  json["estimator"] = report.estimator;
  json["front_end"] = report.front_end;
  json["digest"] = report.digest;
  json["trouble"] = report.input_trouble;
  json["unread"] = unread(source.run.skipped);
  json["steps"] = report.steps;
  json["starts_at_us"] = to_us(first);
  json["nees_bounds"] = {page_number(chi2_quantile(0.025, 3)), page_number(chi2_quantile(0.975, 3))};
  json["metrics"] = metrics(report);
  json["series"] = series(columns, kMostPageInstants / std::max<std::size_t>(1, runs));
  json["health"] = healths(result.healths);
  json["map"] = page_map(replay_picture(source.run, result, report, source.classes));
  json["pictures"] = pictures(source.pictures, first);
  return json;
}

std::string page_data(const std::vector<Json>& runs, const std::string& made_by) {
  const Json data{{"made_by", made_by}, {"runs", runs}};
  // ASCII output, so that neither line separators nor invalid UTF-8 in names can break the page.
  return data.dump(-1, ' ', true, Json::error_handler_t::replace);
}

std::string replay_page(const std::vector<Json>& runs, const std::string& made_by) {
  std::string title;
  for (const Json& run : runs) title += (title.empty() ? "" : ", ") + run.at("name").get<std::string>();
  return html_page(title + " - Azimuth", page_data(runs, made_by));
}

}  // namespace azimuth
