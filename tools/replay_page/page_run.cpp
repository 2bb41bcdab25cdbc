#include "tools/replay_page/page_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string_view>
#include <utility>

#include "slam/geometry/angle.hpp"
#include "tools/evaluate/statistics.hpp"
#include "tools/page/html_page.hpp"
#include "tools/page/thinning.hpp"
#include "tools/replay/replay_picture.hpp"
#include "tools/replay_page/page_map.hpp"
#include "tools/replay_page/page_series.hpp"

namespace azimuth {
namespace {

// The figures of a run in the comparison table of a page.

struct PageMetric {
  /// Rule for which of two values is better.
  enum class Better { neither, lower, higher, nearer_to_three };

  std::string_view key;    ///< identifier, equal for all runs
  std::string_view label;  ///< name for the user
  std::string_view unit;   ///< empty for a plain number
  double value = kNotMeasured;
  int decimals = 0;
  Better better = Better::neither;
  std::string note = {};  ///< explanation for the user
};

using Metrics = std::vector<PageMetric>;

using Better = PageMetric::Better;

void add_poses(const Report& report, Metrics& metrics) {
  metrics.push_back({"rmse", "Position error, RMS", "m", report.position_m.rmse, 3, Better::lower});
  metrics.push_back({"max", "Position error, largest", "m", report.position_m.max, 3, Better::lower});
  metrics.push_back(
      {"heading", "Heading error, RMS", "\u00b0", rad_to_degrees(report.heading_rad.rmse), 2, Better::lower});
  metrics.push_back({"odometry", "Odometry alone, RMS", "m", report.odometry_m.rmse, 3, Better::neither});
  metrics.push_back({"anees", "ANEES (3 is ideal)", "", report.consistency.anees, 2, Better::nearer_to_three});
  metrics.push_back(
      {"anees_tracking", "ANEES while tracking", "", report.tracking_consistency.anees, 2, Better::nearer_to_three});
  if (!report.hindsight) return;
  metrics.push_back(
      {"hindsight", "Position error in hindsight, RMS", "m", report.hindsight->position_m.rmse, 3, Better::lower});
  metrics.push_back(
      {"hindsight_anees", "ANEES in hindsight", "", report.hindsight->consistency.anees, 2, Better::nearer_to_three});
}

void add_health(const HealthReport& report, Metrics& metrics) {
  if (!std::isfinite(report.blind.longest_s)) return;
  constexpr std::array<std::pair<std::string_view, std::string_view>, kHealths.size()> kNames{
      {{"starting", "Starting"}, {"tracking", "Tracking"}, {"degraded", "Degraded"}, {"lost", "Lost"}}};
  for (std::size_t i = 0; i < kHealths.size(); ++i) {
    const HealthTime& time = report.of(kHealths[i]);
    const Better better = kHealths[i] == Health::tracking ? Better::higher : Better::lower;
    metrics.push_back(
        {kNames[i].first, kNames[i].second, "%", 100.0 * time.share, 1, better,
         fmt::format("{:.1f} s{}{}", time.seconds, time.first_reason.empty() ? "" : ", first ", time.first_reason)});
  }
  metrics.push_back(
      {"blind", "Driven without a used bearing", "m", report.blind.driven_m, 2, Better::lower,
       fmt::format("of {:.2f} m; longest time without one {:.1f} s", report.blind.path_m, report.blind.longest_s)});
}

void add_map(const Report& report, Metrics& metrics) {
  const auto number = [](std::size_t count) { return static_cast<double>(count); };
  metrics.push_back({"landmarks", report.natural_features ? "Features" : "Landmarks", "", number(report.map.landmarks),
                     0, Better::neither,
                     report.settled_landmarks ? fmt::format("{} of them settled", *report.settled_landmarks) : ""});
  const bool by_name = report.named_map.named > 0;
  const ErrorStatistics& errors = by_name ? report.named_map.position_m : report.map.position_m;
  if (errors.count == 0) return;
  metrics.push_back({"map_rmse", "Map error, RMS", "m", errors.rmse, 3, Better::lower,
                     fmt::format("{} of {} true landmarks, {}", by_name ? report.named_map.named : report.map.matched,
                                 report.map.true_landmarks, by_name ? "by name" : "one to one")});
  metrics.push_back({"duplicates", "Landmarks mapped twice", "",
                     number(by_name ? report.named_map.duplicates : report.map.duplicates), 0, Better::lower});
  metrics.push_back({"phantoms", "Landmarks of nothing", "", number(report.map.phantoms), 0, Better::lower});
  metrics.push_back({"pair_distances", "Distances between landmarks, RMS error", "m", report.map.pair_distance_rms_m, 3,
                     Better::lower});
}

void add_bearings(const Report& report, Metrics& metrics) {
  const auto accepted = static_cast<double>(report.association.accepted);
  const auto rejected = static_cast<double>(report.association.rejected);
  metrics.push_back({"accepted", "Bearings used", "", accepted, 0, Better::neither});
  if (accepted + rejected > 0.0)
    metrics.push_back({"rejected", "Bearings refused", "%", 100.0 * rejected / (accepted + rejected), 2, Better::lower,
                       fmt::format("{:.0f}", rejected)});
  const SightingErrors& sightings = report.association.sightings;
  if (sightings.judged > 0)
    metrics.push_back({"wrong", "Bearings taken for another's", "%",
                       100.0 * static_cast<double>(sightings.wrong) / static_cast<double>(sightings.judged), 2,
                       Better::lower, fmt::format("{} of {} judged", sightings.wrong, sightings.judged)});
}

/// The measured figures of the report.
std::vector<PageMetric> page_metrics(const Report& report) {
  Metrics metrics;
  add_poses(report, metrics);
  add_health(report.health_over_time, metrics);
  add_map(report, metrics);
  add_bearings(report, metrics);
  metrics.push_back(
      {"step", "Step time, median", "\u00b5s", report.step.median_us, 0, Better::neither, why_too_slow(report)});
  metrics.push_back({"step_p99", "Step time, 99 %", "\u00b5s", report.step.p99_us, 0, Better::neither});
  std::erase_if(metrics, [](const PageMetric& metric) { return !std::isfinite(metric.value); });
  return metrics;
}

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
