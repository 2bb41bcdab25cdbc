#include "tools/replay_page/page_metrics.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <utility>

#include "slam/geometry/angle.hpp"
#include "tools/evaluate/pace.hpp"

namespace azimuth {
namespace {

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

}  // namespace

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

}  // namespace azimuth
