// Hours of simulated driving among named landmarks through the smoother: what an image costs and how much memory there
// is, every ten minutes, and how good the poses are.
//
// usage: long_drive [hall|lab [MINUTES [MAX_KEYFRAMES [SEED]]]]

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fmt/format.h>
#include <fstream>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "sim/world/run_of.hpp"
#include "sim/world/simulate.hpp"
#include "slam/estimator/odometry_track.hpp"
#include "slam/hindsight/make_smoother_estimator.hpp"
#include "slam/hindsight/smoother_estimator.hpp"
#include "tests/support/large_hall.hpp"
#include "tests/support/simulated_drive.hpp"
#include "tools/evaluate/pose_error.hpp"
#include "tools/evaluate/statistics.hpp"

namespace azimuth {
namespace {

constexpr double kReport_s = 600.0;
constexpr int kImagesPerEstimate = 50;  // all landmarks with their covariances: whoever wants them does not always

double cpu_time_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double resident_mb() {
  std::ifstream status("/proc/self/statm");
  double pages = 0.0;
  status >> pages >> pages;
  return pages * 4096.0 / 1e6;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

struct Judged {
  PoseErrors errors;
  double anees = 0.0;
};

Judged judged(const World& world, const std::vector<EstimateRecord>& estimates) {
  std::vector<StampedPose> truth, estimated;
  for (const TruePose& pose : world.truth) truth.push_back({pose.stamp, pose.T_world_body});
  for (const EstimateRecord& estimate : estimates) estimated.push_back({estimate.stamp, estimate.T_map_body});
  const std::vector<PosePair> pairs = pair_with_truth(estimated, truth);
  const auto T_world_map = alignment(pairs);
  if (!T_world_map) return {};
  return {pose_errors(pairs, *T_world_map), consistency(pairs, estimates).anees};
}

std::string text(const Judged& judged) {
  return fmt::format("{:.3f} m (ANEES {:.2f})", error_statistics(judged.errors.position_m).rmse, judged.anees);
}

void drive(const Scenario& scenario, int max_keyframes) {
  const World world = simulate(scenario);
  const Rig rig = rig_of(scenario);
  HindsightSettings settings;
  settings.max_keyframes = max_keyframes;
  const auto made = make_smoother_estimator(rig, settings);
  auto& estimator = static_cast<SmootherEstimator&>(*made);
  OdometryTrack track(rig.odometry);
  std::vector<EstimateRecord> online;
  std::vector<double> step_us, estimate_us;
  std::size_t read = 0;
  Estimate said;
  double report_s = kReport_s;
  fmt::print("{}: {} landmarks, {} images; at the start {:.0f} MB\n", scenario.name, scenario.landmarks.size(),
             world.bearings.size(), resident_mb());
  online.reserve(world.bearings.size());
  for (const BearingSet& set : world.bearings) {
    while (read < world.odometry.size() && (track.empty() || track.newest() < set.stamp))
      track.add(world.odometry[read++]);
    const OdometryTrack::Step step = track.advance_to(set.stamp);
    const double start_s = cpu_time_s();
    estimator.predict(step.motion);
    estimator.update(set);
    const double updated_s = cpu_time_s();
    step_us.push_back(1e6 * (updated_s - start_s));
    const PoseGaussian pose = estimator.mapper().pose();
    online.push_back({set.stamp, pose.T_map_body, pose.covariance, step.T_odom_body});
    if (online.size() % kImagesPerEstimate == 0) {
      said.landmarks.clear();
      said.accepted.clear();
      const double asked_s = cpu_time_s();
      estimator.estimate(said);
      estimate_us.push_back(1e6 * (cpu_time_s() - asked_s));
    }
    if (to_seconds(set.stamp - world.bearings.front().stamp) < report_s && &set != &world.bearings.back()) continue;
    const TimeStatistics times = time_statistics(step_us), all = time_statistics(estimate_us);
    const Smoother& smoother = estimator.mapper().smoother();
    const BearingGraph& graph = smoother.graph();
    fmt::print(
        "{:4.0f} min  {:5} keyframes, {:6} bearings, {:4} landmarks, {:7} in the factor; update mean {:5.0f} us  "
        "median {:5.0f}  99 % {:6.0f}  max {:6.0f}; estimate {:6.0f} us; {:4.0f} MB; so far {}\n",
        report_s / 60.0, graph.poses(), graph.bearings(), graph.landmarks(), smoother.factor().factor_entries(),
        mean(step_us), times.median_us, times.p99_us, times.max_us, all.median_us, resident_mb(),
        text(judged(world, online)));
    std::fflush(stdout);
    step_us.clear();
    estimate_us.clear();
    report_s += kReport_s;
  }
  const double start_s = cpu_time_s();
  std::vector<PastPose> past;
  estimator.write_past(past);
  const double past_s = cpu_time_s() - start_s;
  for (std::size_t i = 0; i < past.size(); ++i) {
    online[i].T_map_body = past[i].T_map_body;
    online[i].covariance = past[i].covariance;
  }
  fmt::print("in hindsight {}, told in {:.2f} s; {:.0f} MB\n", text(judged(world, online)), past_s, resident_mb());
}

}  // namespace
}  // namespace azimuth

int main(int count, char** arguments) {
  const std::string_view where = count > 1 ? arguments[1] : "hall";
  const double minutes = count > 2 ? std::strtod(arguments[2], nullptr) : 120.0;
  const int max_keyframes = count > 3 ? std::atoi(arguments[3]) : azimuth::HindsightSettings{}.max_keyframes;
  const std::uint64_t seed = count > 4 ? std::strtoull(arguments[4], nullptr, 10) : 1;
  azimuth::drive(where == "lab" ? azimuth::long_lab(seed, minutes) : azimuth::large_hall(seed, minutes), max_keyframes);
}
