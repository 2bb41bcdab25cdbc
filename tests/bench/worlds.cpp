// Random worlds of identical landmarks with clutter and missed detections: the share of pose errors within two of the
// stated standard deviations, over many drives.
//
// usage: worlds [OPTION...]      e.g. worlds --threads 2; see --help

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "settings/configuration.hpp"
#include "tests/support/cpu_time.hpp"
#include "tests/support/random_world.hpp"
#include "tests/support/threaded_workers.hpp"
#include "tests/support/world_score.hpp"

namespace azimuth {
namespace {

constexpr double kMostAnees = 6.0, kMostlyWithin = 0.9;

struct Options {
  std::vector<std::uint64_t> seeds{1, 200};
  int threads = 1;
  std::vector<std::string> overrides{"estimator=smoother"};
};

std::string percent(double share) { return fmt::format("{:3.0f} %", 100.0 * share); }

double share_of(const Report& report, Health health) { return report.health_over_time.of(health).share; }

std::string about(const RandomWorld& world) {
  const Scenario& scenario = world.scenario;
  const BearingSensorSettings& sensor = scenario.sensor;
  return fmt::format("{:<9} {:4.1f} x {:4.1f} m, {:2} landmarks within {:4.1f} m, {:.1f} deg, of nothing {}, missed {}",
                     scenario.name, world.room.high_m.x(), world.room.high_m.y(), scenario.landmarks.size(),
                     sensor.max_range_m, rad_to_degrees(sensor.sigma_bearing_rad), percent(world.clutter_share),
                     percent(1.0 - sensor.detection_probability));
}

std::string line(const RandomWorld& world, const WorldScore& score, double cpu_s) {
  const Report& report = score.report;
  const std::span<const WorldScore> alone(&score, 1);
  const auto within = [&](SigmaMeasure measure) {
    return percent(share_within(two_sigma_shares(alone, measure, false)));
  };
  return fmt::format(
      "{} | odometry {:.3f} m, live {:.3f}, at most {:.3f}, ANEES {:4.1f}, tracking {:4.1f} | within the ellipse {}, "
      "2 sigma {} | tracking {}, degraded {}, starting {}, lost {} | {} of {} mapped, {} twice | {:.1f} s\n",
      about(world), report.odometry_m.rmse, report.position_m.rmse, report.position_m.max, report.consistency.anees,
      report.tracking_consistency.anees, within(SigmaMeasure::ellipse), within(SigmaMeasure::direction),
      percent(share_of(report, Health::tracking)), percent(share_of(report, Health::degraded)),
      percent(share_of(report, Health::starting)), percent(share_of(report, Health::lost)), report.map.matched,
      report.map.true_landmarks, report.map.duplicates, cpu_s);
}

/// Prints the lines in the order of the worlds, each as soon as all previous ones are printed.
class InOrder {
 public:
  explicit InOrder(std::size_t count) : lines_(count) {}
  void add(std::size_t index, std::string line) {
    const std::scoped_lock lock(mutex_);
    lines_[index] = std::move(line);
    for (; next_ < lines_.size() && lines_[next_]; ++next_) std::fputs(lines_[next_]->c_str(), stdout);
    std::fflush(stdout);
  }

 private:
  std::mutex mutex_;
  std::vector<std::optional<std::string>> lines_;
  std::size_t next_ = 0;
};

std::vector<WorldScore> drive(const Options& options, const Configuration& configuration) {
  const std::uint64_t first = options.seeds[0], last = options.seeds[1];
  std::vector<WorldScore> scores(last < first ? 0 : last - first + 1);
  InOrder lines(scores.size());
  ThreadedWorkers(options.threads).for_each(scores.size(), [&](std::size_t i) {
    const double start_s = cpu_time_s();
    const RandomWorld world = random_world(first + i);
    scores[i] = score_without_names(run_through(world), configuration);
    lines.add(i, line(world, scores[i], cpu_time_s() - start_s));
  });
  return scores;
}

void print_distribution(const std::string& which, const std::vector<double>& shares) {
  fmt::print(
      "{:<32} {:6} images, within {:5.1f} %; 50 % {:.2f}  75 % {:.2f}  90 % {:.2f}  95 % {:.2f}  99 % {:.2f}  "
      "worst {:.2f}\n",
      which, shares.size(), 100.0 * share_within(shares), quantile(shares, 0.5), quantile(shares, 0.75),
      quantile(shares, 0.9), quantile(shares, 0.95), quantile(shares, 0.99), quantile(shares, 1.0));
}

void print_all(const std::vector<WorldScore>& worlds) {
  fmt::print("\nerror over what two sigma allow, live:\n");
  for (const bool tracking : {false, true})
    for (const SigmaMeasure measure : {SigmaMeasure::ellipse, SigmaMeasure::direction})
      print_distribution(
          fmt::format("{}, {}", measure == SigmaMeasure::ellipse ? "95 % ellipse" : "2 sigma in direction",
                      tracking ? "tracking" : "all"),
          two_sigma_shares(worlds, measure, tracking));

  const double n = static_cast<double>(worlds.size());
  double live_m = 0.0, odometry_m = 0.0, anees = 0.0, tracking = 0.0, worst_tracking = 0.0;
  int worse_than_odometry = 0, mostly_within = 0, above = 0, drives_tracking = 0;
  for (const WorldScore& world : worlds) {
    const Report& report = world.report;
    live_m += report.position_m.rmse / n;
    odometry_m += report.odometry_m.rmse / n;
    anees += report.consistency.anees / n;
    tracking += share_of(report, Health::tracking) / n;
    worse_than_odometry += report.position_m.rmse > report.odometry_m.rmse ? 1 : 0;
    const std::span<const WorldScore> alone(&world, 1);
    mostly_within += share_within(two_sigma_shares(alone, SigmaMeasure::ellipse, false)) >= kMostlyWithin ? 1 : 0;
    if (!(report.tracking_consistency.anees >= 0.0)) continue;
    ++drives_tracking;
    worst_tracking = std::max(worst_tracking, report.tracking_consistency.anees);
    above += report.tracking_consistency.anees > kMostAnees ? 1 : 0;
  }
  fmt::print(
      "{} worlds: odometry {:.3f} m, live {:.3f} m, worse than odometry in {}; ANEES {:.2f}; {:.0f} % of the images "
      "within the ellipse in {}; tracking {:.0f} % of the time, ANEES above {:.0f} in {} of {}, at worst {:.1f}\n",
      worlds.size(), odometry_m, live_m, worse_than_odometry, anees, 100.0 * kMostlyWithin, mostly_within,
      100.0 * tracking, kMostAnees, above, drives_tracking, worst_tracking);
}

}  // namespace
}  // namespace azimuth

int main(int count, char** arguments) {
  using namespace azimuth;
  CLI::App app{"Random worlds of landmarks all alike: how far errors lie within two sigma of what is said"};
  Options options;
  std::vector<std::string> more;
  app.add_option("--seeds", options.seeds, "First and last world")->expected(2)->capture_default_str();
  app.add_option("--threads", options.threads, "Worlds side by side")->capture_default_str();
  app.add_option("--set", more, "Override one key of the configuration; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  CLI11_PARSE(app, count, arguments);
  options.overrides.insert(options.overrides.end(), more.begin(), more.end());
  const auto configuration = read_configuration("", "--set", options.overrides);
  if (!configuration) {
    fmt::print(stderr, "{}\n", text(configuration.error()));
    return 2;
  }
  print_all(drive(options, *configuration));
  return 0;
}
