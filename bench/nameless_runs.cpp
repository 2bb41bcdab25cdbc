// Recorded runs whose names are not looked at through the hypotheses: how good poses and map are, and what an image
// costs.
//
// usage: nameless_runs RUN...      e.g. nameless_runs ../shared/data/lab-runs/*

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <limits>
#include <string>

#include "settings/rig.hpp"
#include "tests/support/nameless_run.hpp"
#include "tests/support/threaded_workers.hpp"
#include "tools/evaluate/statistics.hpp"

namespace azimuth {
namespace {

double number(const char* name, double otherwise) {
  const char* const text = std::getenv(name);
  return text != nullptr ? std::atof(text) : otherwise;
}

struct Sums {
  double online = 0, anees = 0, worst = 0, worst_anees = 0, smoothed = 0, smoothed_anees = 0, odometry = 0, mapped = 0,
         duplicates = 0, wrong = 0, assigned = 0, energy = 0, mean_us = 0, max_us = 0;
  int runs = 0, worse_than_odometry = 0;
};

std::vector<EstimateRecord> odometry_alone(std::vector<EstimateRecord> records) {
  for (EstimateRecord& record : records) record.T_map_body = record.T_odom_body;
  return records;
}

int measure(const std::string& path, Sums& sums) {
  const auto run = load_run(path);
  if (!run) {
    fmt::print(stderr, "{}\n", text(run.error()));
    return 1;
  }
  const Rig rig = *read_rig(run->rig_toml, run->rig_file);
  Scene scene;
  scene.sigma_bearing_rad = number("SIGMA", rig.camera.sigma_bearing_rad);
  scene.field_of_view_rad = rig.camera.field_of_view_rad;
  scene.range_m = number("RANGE", scene.range_m);
  scene.detection_probability = number("PD", scene.detection_probability);
  scene.clutter_per_rad = number("CLUTTER", scene.clutter_per_rad);
  scene.new_per_rad = number("NEW", scene.new_per_rad);
  SmootherSettings smoother = doubting_smoother();
  smoother.converged_below = number("CONV", smoother.converged_below);
  smoother.kernel_width = number("WIDTH", smoother.kernel_width);
  smoother.max_iterations = static_cast<int>(number("ITER", smoother.max_iterations));
  NamelessSettings settings = nameless_settings_for(rig, scene, smoother);
  HypothesisCosts& costs = settings.beam.hypothesis.costs;
  costs = {number("CU", costs.unassigned), number("CL", costs.landmark), number("CM", costs.missed)};
  settings.beam.members = static_cast<int>(number("MEMBERS", settings.beam.members));
  settings.beam.temperature = number("TEMP", settings.beam.temperature);
  settings.beam.images_between_resampling = static_cast<int>(number("EVERY", settings.beam.images_between_resampling));
  ThreadedWorkers threads(static_cast<int>(number("THREADS", 1)));
  InTurn in_turn;
  Workers& workers = number("THREADS", 1) > 1 ? static_cast<Workers&>(threads) : in_turn;

  NamelessMapScore map;
  const NamelessRun result = nameless_run(*run, rig, settings, workers, map);
  const RunError online = run_error(*run, result.online), smoothed = run_error(*run, result.smoothed),
                 odometry = run_error(*run, odometry_alone(result.online));
  const TimeStatistics times = time_statistics(result.step_us);
  double mean_us = 0;
  for (const double us : result.step_us) mean_us += us / static_cast<double>(result.step_us.size());
  const auto vague = std::count_if(result.gaps.begin(), result.gaps.end(), [](double gap) { return gap < 3.0; });
  fmt::print(
      "{:<12} odo {:.3f} online {:.3f} m ({:5.1f}) smoothed {:.3f} m ({:5.1f}) map {:2} of {} dup {} wrong {} of {} "
      "({} bearings) E {:.1f} gap<3 {} of {} ms {:.2f} 99% {:.2f} max {:.2f}\n",
      run->name, odometry.rmse_m, online.rmse_m, online.anees, smoothed.rmse_m, smoothed.anees, map.mapped,
      run->landmarks.size(), map.duplicates, map.wrong, map.assigned, map.bearings, result.energy, vague,
      result.gaps.size(), 1e-3 * mean_us, 1e-3 * times.p99_us, 1e-3 * times.max_us);
  sums.online += online.rmse_m;
  sums.anees += online.anees;
  sums.smoothed += smoothed.rmse_m;
  sums.smoothed_anees += smoothed.anees;
  sums.odometry += odometry.rmse_m;
  sums.worst = std::max(sums.worst, online.rmse_m);
  sums.worst_anees = std::max(sums.worst_anees, online.anees);
  sums.mapped += map.mapped;
  sums.duplicates += map.duplicates;
  sums.wrong += map.wrong;
  sums.energy += result.energy;
  sums.assigned += map.assigned;
  sums.mean_us += mean_us;
  sums.max_us = std::max(sums.max_us, times.max_us);
  sums.worse_than_odometry += online.rmse_m > odometry.rmse_m ? 1 : 0;
  ++sums.runs;
  return 0;
}

}  // namespace
}  // namespace azimuth

int main(int count, char** arguments) {
  azimuth::Sums sums;
  for (int i = 1; i < count; ++i)
    if (azimuth::measure(arguments[i], sums) != 0) return 1;
  const double n = sums.runs;
  if (sums.runs > 1)
    fmt::print(
        "mean of {}: odo {:.3f} online {:.3f} ({:.2f}) worst {:.3f} ({:.1f}) worse than odo {} smoothed {:.3f} "
        "({:.2f}) mapped "
        "{:.1f} dup {:.2f} wrong {:.1f} of {:.0f} E {:.1f} ms {:.2f} max {:.2f}\n",
        sums.runs, sums.odometry / n, sums.online / n, sums.anees / n, sums.worst, sums.worst_anees,
        sums.worse_than_odometry, sums.smoothed / n, sums.smoothed_anees / n, sums.mapped / n, sums.duplicates / n,
        sums.wrong / n, sums.assigned / n, sums.energy / n, 1e-3 * sums.mean_us / n, 1e-3 * sums.max_us);
}
