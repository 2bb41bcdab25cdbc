// Hours of simulated driving among named landmarks with the smoother. Every ten minutes it reports the time per image
// in the last minute and in all ten, the memory, and the accuracy of the poses.
//
// usage: long_drive [lab|hall] [OPTION...]; see --help

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <fmt/format.h>
#include <fstream>
#include <numeric>
#include <string>
#include <vector>

#include "tests/support/cpu_time.hpp"
#include "tests/support/hindsight_drive.hpp"
#include "tests/support/large_hall.hpp"
#include "tools/evaluate/statistics.hpp"

namespace azimuth {
namespace {

constexpr double kReport_s = 600.0, kLast_s = 60.0;

double resident_mb() {
  std::ifstream status("/proc/self/statm");
  double pages = 0.0;
  status >> pages >> pages;
  return pages * 4096.0 / 1e6;
}

double mean(const std::vector<double>& values) {
  return values.empty() ? 0.0 : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::string text(const HindsightDrive::Errors& errors) {
  return fmt::format("{:.3f} m (ANEES {:.2f})", errors.rmse_m, errors.anees);
}

void drive(const Scenario& scenario, int max_keyframes) {
  HindsightSettings settings;
  settings.max_keyframes = max_keyframes;
  HindsightDrive drive(scenario, settings);
  const World& world = drive.world();
  std::vector<double> step_us, last_us;
  double report_s = kReport_s;
  fmt::print("{}: {} landmarks, {} images; at the start {:.0f} MB\n", scenario.name, scenario.landmarks.size(),
             world.bearings.size(), resident_mb());
  while (!drive.done()) {
    const double at_s = to_seconds(drive.next() - world.bearings.front().stamp);
    step_us.push_back(1e6 * drive.hear_s());
    if (at_s > report_s - kLast_s) last_us.push_back(step_us.back());
    if (!drive.done() && to_seconds(drive.next() - world.bearings.front().stamp) <= report_s) continue;
    const TimeStatistics times = time_statistics(step_us);
    const BearingGraph& graph = drive.graph();
    fmt::print(
        "{:4.0f} min  {:5} keyframes, {:6} bearings, {:4} landmarks, {:7} in the factor; an image {:5.0f} us in "
        "the last minute; in all ten {:5.0f}  median {:5.0f}  99 % {:6.0f}  max {:6.0f}; {:4.0f} MB; so far {}\n",
        report_s / 60.0, graph.poses(), graph.bearings(), graph.landmarks(),
        drive.estimator().mapper().smoother().factor().factor_entries(), mean(last_us), mean(step_us), times.median_us,
        times.p99_us, times.max_us, resident_mb(), text(drive.online()));
    std::fflush(stdout);
    step_us.clear();
    last_us.clear();
    report_s += kReport_s;
  }
  const double start_s = cpu_time_s();
  const std::string hindsight = text(drive.hindsight());
  fmt::print("in hindsight {}, told and judged in {:.2f} s; {:.0f} MB\n", hindsight, cpu_time_s() - start_s,
             resident_mb());
}

}  // namespace
}  // namespace azimuth

int main(int count, char** arguments) {
  using namespace azimuth;
  CLI::App app{"Hours of simulated driving through the smoother: what an image costs, and how much memory there is"};
  std::string where = "hall";
  double minutes = 120.0;
  int max_keyframes = HindsightSettings{}.max_keyframes;
  std::uint64_t seed = 1;
  app.add_option("WHERE", where, "Among 24 landmarks or 2,000")
      ->check(CLI::IsMember({"lab", "hall"}))
      ->capture_default_str();
  app.add_option("--minutes", minutes, "Of driving")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--max-keyframes", max_keyframes, "That are kept; 0: all")->capture_default_str();
  app.add_option("--seed", seed, "Of the drive")->capture_default_str();
  CLI11_PARSE(app, count, arguments);
  drive(where == "lab" ? long_lab(seed, minutes) : large_hall(seed, minutes), max_keyframes);
  return 0;
}
