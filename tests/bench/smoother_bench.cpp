// The smoother's time for one more image, compared with one step of a solver that assembles and factorises everything
// anew: Eigen's, and CHOLMOD if it is installed.

#include <Eigen/SparseCholesky>
#include <benchmark/benchmark.h>

#include "tests/bench/smoother_world.hpp"
#include "tests/bench/step_times.hpp"
#include "tests/support/batch_solution.hpp"
#ifdef AZIMUTH_HAS_CHOLMOD
#include <Eigen/CholmodSupport>
#endif

namespace azimuth {
namespace {

constexpr int kMeasuredImages = 200;

void one_more_image(benchmark::State& state) {
  const auto images = static_cast<int>(state.range(0));
  const NamedDrive drive = bench::long_drive(images + kMeasuredImages);
  DriveFeeder feeder(drive);
  Smoother smoother = bench::driven(feeder, images, SmootherSettings{});
  {
    bench::StepTimes times(state);
    for (auto _ : state) {
      times.time([&] {
        feeder.feed(smoother);
        smoother.optimise();
        benchmark::DoNotOptimize(smoother.newest_covariance());
      });
    }
  }
  state.counters["fronts"] = static_cast<double>(smoother.factor().fronts());
  state.counters["factor_entries"] = static_cast<double>(smoother.factor().factor_entries());
}
BENCHMARK(one_more_image)
    ->ArgName("keyframes")
    ->Arg(300)
    ->Arg(1500)
    ->Arg(4500)
    ->UseManualTime()
    ->Iterations(kMeasuredImages);

void everything_anew(benchmark::State& state) {
  const auto images = static_cast<int>(state.range(0));
  const NamedDrive drive = bench::long_drive(images);
  DriveFeeder feeder(drive);
  Smoother smoother = bench::driven(feeder, images, SmootherSettings{});
  bench::StepTimes times(state);
  for (auto _ : state) {
    smoother.start_factor_anew();
    times.time([&] { smoother.optimise(0); });
  }
}
BENCHMARK(everything_anew)->ArgName("keyframes")->Arg(300)->Arg(1500)->Arg(4500)->UseManualTime();

void a_copy(benchmark::State& state) {
  const auto images = static_cast<int>(state.range(0));
  const NamedDrive drive = bench::long_drive(images);
  DriveFeeder feeder(drive);
  const Smoother smoother = bench::driven(feeder, images, SmootherSettings{});
  for (auto _ : state) {
    Smoother copy = smoother;
    copy.add_bearing(0.0, 0.01);
    benchmark::DoNotOptimize(copy.energy());
  }
}
BENCHMARK(a_copy)->ArgName("keyframes")->Arg(300)->Arg(1500);

/// Ordering, factorisation and solution of a given matrix; `keep_order` reuses the ordering of an earlier call.
template <class Factor>
void factorise(benchmark::State& state, bool keep_order) {
  const auto images = static_cast<int>(state.range(0));
  const NamedDrive drive = bench::long_drive(images);
  DriveFeeder feeder(drive);
  const Smoother smoother = bench::driven(feeder, images, SmootherSettings{});
  const BatchProblem batch(smoother.graph(), SmootherSettings{});
  const BatchProblem::Normal normal = batch.normal();
  Factor factor;
  factor.analyzePattern(normal.H);
  {
    bench::StepTimes times(state);
    for (auto _ : state) {
      times.time([&] {
        if (!keep_order) factor.analyzePattern(normal.H);
        factor.factorize(normal.H);
        benchmark::DoNotOptimize(Eigen::VectorXd(factor.solve(normal.gradient)));
      });
    }
  }
  state.counters["unknowns"] = static_cast<double>(batch.rows());
}

using Sparse = Eigen::SparseMatrix<double>;
void eigen_ordered_anew(benchmark::State& state) { factorise<Eigen::SimplicialLDLT<Sparse>>(state, false); }
void eigen_order_kept(benchmark::State& state) { factorise<Eigen::SimplicialLDLT<Sparse>>(state, true); }
BENCHMARK(eigen_ordered_anew)->ArgName("keyframes")->Arg(300)->Arg(1500)->Arg(4500)->UseManualTime();
BENCHMARK(eigen_order_kept)->ArgName("keyframes")->Arg(300)->Arg(1500)->Arg(4500)->UseManualTime();
#ifdef AZIMUTH_HAS_CHOLMOD
void cholmod_ordered_anew(benchmark::State& state) { factorise<Eigen::CholmodDecomposition<Sparse>>(state, false); }
void cholmod_order_kept(benchmark::State& state) { factorise<Eigen::CholmodDecomposition<Sparse>>(state, true); }
BENCHMARK(cholmod_ordered_anew)->ArgName("keyframes")->Arg(300)->Arg(1500)->Arg(4500)->UseManualTime();
BENCHMARK(cholmod_order_kept)->ArgName("keyframes")->Arg(300)->Arg(1500)->Arg(4500)->UseManualTime();
#endif

}  // namespace
}  // namespace azimuth
