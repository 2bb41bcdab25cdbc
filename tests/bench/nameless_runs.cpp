// Processes recorded and simulated runs with the hypotheses, without their names: accuracy of poses and map, agreement
// with the stated trust and covariance, and time per image.
//
// usage: nameless_runs [OPTION...] [RUN...]      e.g. nameless_runs ../shared/data/lab-runs/*; see --help

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <string>

#include "settings/rig.hpp"
#include "tests/support/cone_drive.hpp"
#include "tests/support/hidden_lab.hpp"
#include "tests/support/nameless_run.hpp"
#include "tests/support/narrow_room.hpp"
#include "tests/support/random_world.hpp"
#include "tests/support/street_drive.hpp"
#include "tests/support/threaded_workers.hpp"
#include "tools/evaluate/statistics.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

/// One value of the settings. Without a given value, the rig's value or the default of the library holds.
struct Knob {
  const char *name, *help;
  void (*set)(NamelessSettings& settings, double value);
  std::optional<double> value = std::nullopt;
};

Scene& scene_of(NamelessSettings& settings) { return settings.beam.hypothesis.scene; }

std::vector<Knob> knobs() {
  using S = NamelessSettings;
  return {
      {"--tracks", "Whether each bearing of nothing is a landmark at once",
       [](S& s, double v) { s.beam.hypothesis.tracks.used = v != 0.0; }},
      {"--merge-margin", "Added to what each member asks for to merge landmarks",
       [](S& s, double v) { s.beam.hypothesis.tracks.extra_merge_margin = v; }},
      {"--fresh-margin", "Asked for to give a bearing to a landmark just seen",
       [](S& s, double v) { s.beam.hypothesis.tracks.fresh_margin = v; }},
      {"--most-landmarks", "Members times landmarks at most",
       [](S& s, double v) { s.beam.most_landmarks = static_cast<int>(v); }},
      {"--populations", "Of drawn maps", [](S& s, double v) { s.drawn.populations = static_cast<int>(v); }},
      {"--drawn", "Maps of a population", [](S& s, double v) { s.drawn.members = static_cast<int>(v); }},
      {"--vague", "Bearings predicted no better close no loop [share of the view]",
       [](S& s, double v) { s.drawn.map.vague_share_of_view = v; }},
      {"--members", "Of the beam", [](S& s, double v) { s.beam.members = static_cast<int>(v); }},
      {"--temperature", "A member's weight is exp(-energy / temperature)",
       [](S& s, double v) { s.beam.temperature = v; }},
      {"--resampling", "Images between two",
       [](S& s, double v) { s.beam.images_between_resampling = static_cast<int>(v); }},
      {"--loops", "Images between two looks of a member for itself in its own map",
       [](S& s, double v) { s.beam.images_between_loops = static_cast<int>(v); }},
      {"--sigma", "Of a bearing [rad]", [](S& s, double v) { scene_of(s).sigma_bearing_rad = v; }},
      {"--range", "How far landmarks are seen, to begin with [m]", [](S& s, double v) { scene_of(s).range_m = v; }},
      {"--detection", "Probability that a landmark in view is seen",
       [](S& s, double v) { scene_of(s).detection_probability = v; }},
      {"--clutter", "Bearings of nothing [1/rad]", [](S& s, double v) { scene_of(s).clutter_per_rad = v; }},
      {"--new", "Bearings of nothing mapped yet [1/rad]", [](S& s, double v) { scene_of(s).new_per_rad = v; }},
      {"--kernel-width", "Of the robust kernel [standard deviations]",
       [](S& s, double v) { s.beam.hypothesis.smoother.kernel_width = v; }},
      {"--iterations", "Most of an optimisation",
       [](S& s, double v) { s.beam.hypothesis.smoother.max_iterations = static_cast<int>(v); }},
      {"--thinning", "Least time between two images used [s]", [](S& s, double v) { s.thinning_s = v; }},
  };
}

struct Options {
  std::vector<std::string> runs;
  std::string world;
  std::vector<std::uint64_t> seeds{1, 20};
  int threads = 1;
  std::string trace;
  std::vector<Knob> knobs = azimuth::knobs();
};

struct Sums {
  double online = 0, anees = 0, worst = 0, worst_anees = 0, smoothed = 0, smoothed_anees = 0, odometry = 0,
         odometry_anees = 0, mapped = 0, duplicates = 0, wrong = 0, assigned = 0, energy = 0, mean_us = 0, max_us = 0,
         trusted = 0, worst_trusted_anees = 0;
  int runs = 0, worse_than_odometry = 0, above_six = 0;
};

NamelessSettings settings_of(const Options& options, const Rig& rig) {
  NamelessSettings settings = nameless_settings_for(rig);
  for (const Knob& knob : options.knobs)
    if (knob.value) knob.set(settings, *knob.value);
  HypothesisSettings& hypothesis = settings.beam.hypothesis;
  hypothesis.costs = hypothesis_costs(hypothesis.scene, hypothesis.smoother);
  return settings;
}

std::string numbers_of(const Eigen::Matrix3d& P) {
  return fmt::format("{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}", P(0, 0), P(0, 1), P(0, 2), P(1, 1), P(1, 2), P(2, 2));
}

/// Writes one line per used image: run, time, trust, error and covariance of the pose and of dead reckoning, and the
/// trace.
void write_trace(std::ofstream& out, const Run& run, const NamelessRun& result) {
  const auto errors = errors_of_each(run, result.online), by_odometry = errors_of_each(run, result.odometry);
  for (const NamelessRun::Used& used : result.used) {
    const auto &error = errors[used.record], &odometry = by_odometry[used.record];
    if (!error || !odometry) continue;
    out << fmt::format("{},{:.3f},{},{:.5f},{:.5f},{:.5f},{},{:.5f},{:.5f},{:.5f},{},{}\n", run.name,
                       to_seconds(result.online[used.record].stamp), used.trust.trusted() ? 1 : 0, error->x(),
                       error->y(), error->z(), numbers_of(result.online[used.record].covariance), odometry->x(),
                       odometry->y(), odometry->z(), numbers_of(result.odometry[used.record].covariance), used.trace);
  }
}

void measure(const Run& run, const Options& options, std::ofstream* trace, Sums& sums) {
  const Rig rig = *read_rig(run.rig_toml, run.rig_file);
  ThreadedWorkers threads(options.threads);
  InTurn in_turn;
  Workers& workers = options.threads > 1 ? static_cast<Workers&>(threads) : in_turn;

  NamelessMapScore map;
  const NamelessRun result = nameless_run(run, rig, settings_of(options, rig), workers, map);
  const RunError online = run_error(run, result.online), smoothed = run_error(run, result.smoothed),
                 odometry = run_error(run, result.odometry);
  const TrustScore trust = trust_score(run, result);
  const TimeStatistics times = time_statistics(result.step_us);
  const double mean_us = std::accumulate(result.step_us.begin(), result.step_us.end(), 0.0) /
                         static_cast<double>(std::max<std::size_t>(result.step_us.size(), 1));
  fmt::print(
      "{:<14} odo {:.3f} ({:4.1f}) online {:.3f} m ({:5.1f}) smoothed {:.3f} m ({:5.1f}) trusted {:3.0f} % ({:4.1f}) "
      "map {:2} of {} dup {} +{} wrong {} of {} ({} bearings) E {:.1f} ms {:.2f} 99% {:.2f} max {:.2f}\n",
      run.name, odometry.rmse_m, odometry.anees, online.rmse_m, online.anees, smoothed.rmse_m, smoothed.anees,
      100.0 * trust.share, trust.anees, map.mapped, run.landmarks.size(), map.duplicates,
      map.landmarks - map.mapped - map.duplicates, map.wrong, map.assigned, map.bearings, result.energy, 1e-3 * mean_us,
      1e-3 * times.p99_us, 1e-3 * times.max_us);
  std::fflush(stdout);
  if (trace != nullptr) write_trace(*trace, run, result);
  sums.online += online.rmse_m;
  sums.anees += online.anees;
  sums.smoothed += smoothed.rmse_m;
  sums.smoothed_anees += smoothed.anees;
  sums.odometry += odometry.rmse_m;
  sums.odometry_anees += odometry.anees;
  sums.worst = std::max(sums.worst, online.rmse_m);
  sums.worst_anees = std::max(sums.worst_anees, online.anees);
  sums.trusted += trust.share;
  if (trust.share > 0.0) sums.worst_trusted_anees = std::max(sums.worst_trusted_anees, trust.anees);
  sums.above_six += trust.share > 0.0 && trust.anees > 6.0 ? 1 : 0;
  sums.mapped += map.mapped;
  sums.duplicates += map.duplicates;
  sums.wrong += map.wrong;
  sums.energy += result.energy;
  sums.assigned += map.assigned;
  sums.mean_us += mean_us;
  sums.max_us = std::max(sums.max_us, times.max_us);
  sums.worse_than_odometry += online.rmse_m > odometry.rmse_m ? 1 : 0;
  ++sums.runs;
}

void print_mean(const Sums& sums) {
  const double n = sums.runs;
  fmt::print(
      "mean of {}: odo {:.3f} ({:.2f}) online {:.3f} ({:.2f}) worst {:.3f} ({:.1f}) worse than odo {} smoothed {:.3f} "
      "({:.2f}) trusted {:.0f} % worst ({:.1f}) above 6: {} mapped {:.1f} dup {:.2f} wrong {:.1f} of {:.0f} E {:.1f} "
      "ms {:.2f} max {:.2f}\n",
      sums.runs, sums.odometry / n, sums.odometry_anees / n, sums.online / n, sums.anees / n, sums.worst,
      sums.worst_anees, sums.worse_than_odometry, sums.smoothed / n, sums.smoothed_anees / n, 100.0 * sums.trusted / n,
      sums.worst_trusted_anees, sums.above_six, sums.mapped / n, sums.duplicates / n, sums.wrong / n, sums.assigned / n,
      sums.energy / n, 1e-3 * sums.mean_us / n, 1e-3 * sums.max_us);
}

std::optional<Run> simulated(const std::string& world, std::uint64_t seed) {
  if (world == "hidden-lab") return hidden_lab(seed);
  if (world == "cones") return cone_drive(seed);
  if (world == "narrow-room") return narrow_room(seed);
  if (world == "streets") return street_drive(seed);
  if (world == "random") return run_through(random_world(seed));
  std::optional<Scenario> scenario = scenario_named(world, seed);
  if (!scenario) return std::nullopt;
  Run run = simulated_run(*scenario);
  run.name += fmt::format("-{}", seed);
  return run;
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("RUN", options.runs, "Run folders or logs; their names are used to judge, and for nothing else");
  app.add_option("--world", options.world,
                 "Simulated runs: hidden-lab, cones, random, narrow-room, streets, or a world that `azimuth simulate` "
                 "knows, with names");
  app.add_option("--seeds", options.seeds, "First and last of those")->expected(2)->capture_default_str();
  app.add_option("--threads", options.threads, "That members are spread over")->capture_default_str();
  app.add_option("--trace", options.trace,
                 "File for one line of each image used: run, time, what is said of it and how wrong that is");
  for (Knob& knob : options.knobs) app.add_option(knob.name, knob.value, knob.help);
}

}  // namespace
}  // namespace azimuth

int main(int count, char** arguments) {
  using namespace azimuth;
  CLI::App app{"Runs whose names are not looked at: how good poses and map are, whether they know it, and the cost"};
  Options options;
  add_options(app, options);
  CLI11_PARSE(app, count, arguments);

  std::ofstream trace;
  if (!options.trace.empty()) trace.open(options.trace);
  std::ofstream* const traced = options.trace.empty() ? nullptr : &trace;
  Sums sums;
  for (const std::string& path : options.runs) {
    const auto run = load_run(path);
    if (!run) {
      fmt::print(stderr, "{}\n", text(run.error()));
      return 1;
    }
    measure(*run, options, traced, sums);
  }
  if (!options.world.empty())
    for (std::uint64_t seed = options.seeds[0]; seed <= options.seeds[1]; ++seed) {
      const std::optional<Run> run = simulated(options.world, seed);
      if (!run) {
        fmt::print(stderr, "--world {}: there is none\n", options.world);
        return 1;
      }
      measure(*run, options, traced, sums);
    }
  if (sums.runs > 1) print_mean(sums);
  return 0;
}
