// One step of the whole estimator as in the daemon: association, gates, update, and the output of the estimate.

#include <algorithm>
#include <benchmark/benchmark.h>
#include <vector>

#include "slam/planar/ekf_estimator.hpp"
#include "tests/bench/step_times.hpp"
#include "tests/bench/world.hpp"

namespace azimuth {
namespace {

Rig rig() {
  Rig rig;
  rig.camera.sigma_bearing_rad = bench::kSigmaBearing_rad;
  rig.camera.identities = true;
  return rig;
}

EkfSettings settings() {
  EkfSettings settings;
  settings.initialisation = Initialisation::delayed;
  settings.delayed.kl_threshold = 1e3;  // initialises the map from two poses, whatever its quality
  settings.delayed.kl_samples = 10;
  settings.thinning_s = 0.0;
  return settings;
}

class MappedEstimator {
 public:
  explicit MappedEstimator(int count) : landmarks_(bench::make_landmarks(count)), estimator_(rig(), settings()) {
    for (int first = 0; first < count; first += kAtOnce) {
      look(first, std::min(count, first + kAtOnce));
      drive(bench::kBaseline_m);
      look(first, std::min(count, first + kAtOnce));
      drive(-bench::kBaseline_m);
    }
  }

  void drive(double distance_m) {
    estimator_.predict(bench::straight(distance_m));
    x_m_ += distance_m;
  }

  /// Adds bearings to the landmarks [first, last) from the robot's pose.
  void look(int first, int last) {
    set_.bearings.clear();
    for (int i = first; i < last; ++i)
      set_.bearings.push_back(
          {.azimuth_rad = bench::azimuth_to({x_m_, 0.0, 0.0}, landmarks_[static_cast<std::size_t>(i)]), .identity = i});
    set_.stamp += Duration{100'000};
    estimator_.update(set_);
  }

  const EkfEstimator& estimator() const { return estimator_; }

 private:
  static constexpr int kAtOnce = 20;
  std::vector<Eigen::Vector2d> landmarks_;
  EkfEstimator estimator_;
  BearingSet set_;
  double x_m_ = 0.0;
};

void estimator_step(benchmark::State& state) {
  const auto count = static_cast<int>(state.range(0));
  MappedEstimator world(count);
  Estimate estimate;
  bench::StepTimes times(state);
  double direction = 1.0;
  for (auto _ : state) {
    estimate.landmarks.clear();
    times.time([&] {
      world.drive(direction * bench::kStride_m);
      world.look(0, bench::kSeen);
      world.estimator().estimate(estimate);
    });
    direction = -direction;
  }
  state.counters["mapped"] = static_cast<double>(estimate.landmarks.size());
  state.counters["rejected"] = static_cast<double>(estimate.association.rejected);
}
BENCHMARK(estimator_step)->ArgName("landmarks")->Arg(50)->Arg(100)->Arg(200)->Arg(500)->Arg(1000)->UseManualTime();

}  // namespace
}  // namespace azimuth
