// One step of the filter: prediction and one batch update. 20 bearings have the same number of rows as MRPT's 10
// range-bearing observations; 10 bearings are the daemon's usual step.

#include <benchmark/benchmark.h>
#include <vector>

#include "slam/ekf/bearing_ekf.hpp"
#include "tests/bench/step_times.hpp"
#include "tests/bench/world.hpp"

namespace azimuth {
namespace {

using bench::kSigmaBearing_rad;
using Retraction = JointState::Retraction;

/// A filter with the robot and a fully correlated map of `count` points.
class MappedWorld {
 public:
  MappedWorld(int count, Retraction retraction) : landmarks_(bench::make_landmarks(count)), ekf_(settings(retraction)) {
    ekf_.predict(bench::straight(-0.5 * bench::kBaseline_m));
    const Index start = ekf_.clone_robot();
    ekf_.predict(bench::straight(bench::kBaseline_m));
    for (const Eigen::Vector2d& landmark : landmarks_) {
      const auto seen_from = [&](Index pose) {
        return ekf_.sighting_from(pose, bench::azimuth_to(ekf_.state().pose(pose), landmark));
      };
      const auto meeting = intersect(seen_from(start), seen_from(JointState::kPose));
      blocks_.push_back(ekf_.add_point(*meeting, start, JointState::kPose, kSigmaBearing_rad));
    }
    ekf_.remove(start, BlockKind::pose);
    ekf_.predict(bench::straight(-0.5 * bench::kBaseline_m));
  }

  /// The exact bearings of one image, so that the state does not move.
  std::vector<MappedSighting> look(const Pose2& T_map_body, int rows) const {
    std::vector<MappedSighting> sightings;
    for (int row = 0; row < rows; ++row) {
      const auto landmark = static_cast<std::size_t>(row % bench::kSeen);
      sightings.push_back({JointState::kPose, blocks_[landmark], BlockKind::point,
                           bench::azimuth_to(T_map_body, landmarks_[landmark]), kSigmaBearing_rad * kSigmaBearing_rad});
    }
    return sightings;
  }

  BearingEkf& ekf() { return ekf_; }

 private:
  static BearingEkfSettings settings(Retraction retraction) {
    BearingEkfSettings settings;
    settings.retraction = retraction;
    return settings;
  }
  std::vector<Eigen::Vector2d> landmarks_;
  BearingEkf ekf_;
  std::vector<Index> blocks_;
};

void step(benchmark::State& state, Retraction retraction) {
  MappedWorld world(static_cast<int>(state.range(0)), retraction);
  bench::StepTimes times(state);
  double direction = 1.0;
  for (auto _ : state) {
    const Motion motion = bench::straight(direction * bench::kStride_m);
    const Pose2 T_map_body = apply(world.ekf().state().pose(), motion).T_map_body;
    const std::vector<MappedSighting> sightings = world.look(T_map_body, static_cast<int>(state.range(1)));
    bool applied = false;
    times.time([&] {
      world.ekf().predict(motion);
      applied = world.ekf().update(sightings);
    });
    if (!applied) return state.SkipWithError("the update was refused");
    direction = -direction;
  }
}

void invariant_step(benchmark::State& state) { step(state, Retraction::invariant); }
void additive_step(benchmark::State& state) { step(state, Retraction::additive); }

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"landmarks", "rows"})->ArgsProduct({{50, 100, 200, 500, 1000}, {10, 20}})->UseManualTime();
}
BENCHMARK(invariant_step)->Apply(sizes);
BENCHMARK(additive_step)->Apply(sizes);

}  // namespace
}  // namespace azimuth
