#include "tests/scenarios/replayed.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "settings/rig.hpp"
#include "slam/hindsight/make_smoother_estimator.hpp"
#include "slam/planar/make_ekf_estimator.hpp"
#include "tools/replay/replay_record.hpp"

namespace azimuth {

Rig rig_of(const Run& run) {
  const FileResult<Rig> rig = read_rig(run.rig_toml, run.rig_file);
  EXPECT_TRUE(rig);
  return rig ? *rig : Rig{};
}

Report replayed(const Run& run, const Rig& rig, const EkfSettings& settings) {
  const ReplayResult result = replay(run, rig, make_ekf_estimator(rig, settings), StageSettings{});
  return evaluate(replay_record(run, rig, "ekf", 0, result));
}

Report replayed_in_hindsight(const Run& run, const Rig& rig, const HindsightSettings& settings) {
  const ReplayResult result = replay(run, rig, make_smoother_estimator(rig, settings), StageSettings{});
  return evaluate(replay_record(run, rig, "smoother", 0, result));
}

double Runs::mean_of(const std::function<double(const Report&)>& value) const {
  double sum = 0.0;
  for (const Report& report : reports) sum += value(report);
  return sum / static_cast<double>(reports.size());
}

double Runs::mean_m() const {
  return mean_of([](const Report& report) { return report.position_m.mean; });
}

double Runs::worst_m() const {
  double worst = 0.0;
  for (const Report& report : reports) worst = std::max(worst, report.position_m.max);
  return worst;
}

double Runs::anees() const {
  return mean_of([](const Report& report) { return report.consistency.anees; });
}

double Runs::smoothed_m() const {
  return mean_of(
      [](const Report& report) { return report.hindsight ? report.hindsight->position_m.mean : kNotMeasured; });
}

int Runs::diverged() const {
  return static_cast<int>(
      std::ranges::count_if(reports, [](const Report& report) { return !(report.position_m.max <= kDiverged_m); }));
}

void Runs::print(const std::string& title) const {
  const double odometry_m = mean_of([](const Report& report) { return report.odometry_m.mean; });
  fmt::print("{}, {} runs: mean error {:.3f} m, worst {:.3f} m, diverged {}, ANEES {:.2f}; odometry {:.3f} m", title,
             reports.size(), mean_m(), worst_m(), diverged(), anees(), odometry_m);
  if (!reports.empty() && reports.front().hindsight)
    fmt::print("; in hindsight {:.3f} m, ANEES while tracking {:.2f}", smoothed_m(),
               mean_of([](const Report& report) { return report.tracking_consistency.anees; }));
  fmt::print("\n");
}

Runs replay_seeds(int seeds, const std::function<Report(std::uint64_t seed)>& make) {
  Runs runs;
  for (int seed = 1; seed <= seeds; ++seed) runs.reports.push_back(make(static_cast<std::uint64_t>(seed)));
  return runs;
}

}  // namespace azimuth
