// Recorded runs with known names processed by the smoother: accuracy of the poses and time per image.
//
// usage: smoother_runs [-k MAX_KEYFRAMES] RUN...      e.g. smoother_runs ../shared/data/mrclam6-robot?

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <string>
#include <string_view>

#include "settings/rig.hpp"
#include "tests/support/smoothed_run.hpp"
#include "tools/evaluate/statistics.hpp"

namespace azimuth {
namespace {

struct Sums {
  double online = 0, smoothed = 0, anees = 0, smoothed_anees = 0, worst = 0;
  int runs = 0;
};

int measure(const std::string& path, int max_keyframes, Sums& sums) {
  const auto run = load_run(path);
  if (!run) {
    fmt::print(stderr, "{}\n", text(run.error()));
    return 1;
  }
  const auto rig = read_rig(run->rig_toml, run->rig_file);
  if (!rig) {
    fmt::print(stderr, "{}\n", text(rig.error()));
    return 1;
  }
  KnownNamesSettings settings = settings_for(*rig, SmootherSettings{});
  settings.max_keyframes = max_keyframes;
  const SmoothedRun result = smoothed_run(*run, *rig, settings);
  const RunError online = run_error(*run, result.online), smoothed = run_error(*run, result.smoothed);
  const TimeStatistics times = time_statistics(result.step_us);
  fmt::print(
      "{:<16} online {:.3f} m (ANEES {:.1f})  smoothed {:.3f} m ({:.1f})  {} poses, {} landmarks, {} bearings, energy "
      "{:.1f}, {} damped, {} open  median {:.0f} us  99 % {:.0f}  max {:.0f}\n",
      run->name, online.rmse_m, online.anees, smoothed.rmse_m, smoothed.anees, result.poses, result.landmarks,
      result.bearings, result.energy, result.damped, result.not_converged, times.median_us, times.p99_us, times.max_us);
  sums.online += online.rmse_m;
  sums.smoothed += smoothed.rmse_m;
  sums.anees += online.anees;
  sums.smoothed_anees += smoothed.anees;
  sums.worst = std::max(sums.worst, online.rmse_m);
  ++sums.runs;
  return 0;
}

}  // namespace
}  // namespace azimuth

int main(int count, char** arguments) {
  azimuth::Sums sums;
  const bool thinned = count > 2 && std::string_view(arguments[1]) == "-k";
  const int max_keyframes = thinned ? std::atoi(arguments[2]) : 0;
  for (int i = thinned ? 3 : 1; i < count; ++i)
    if (azimuth::measure(arguments[i], max_keyframes, sums) != 0) return 1;
  if (sums.runs > 1)
    fmt::print("mean             online {:.3f} m ({:.2f}), worst {:.3f}  smoothed {:.3f} m ({:.2f})\n",
               sums.online / sums.runs, sums.anees / sums.runs, sums.worst, sums.smoothed / sums.runs,
               sums.smoothed_anees / sums.runs);
}
