// Compares gated assignment with dlib's, if dlib is installed. dlib needs square integer matrices: outside the measured
// time the problem is padded with rows of zeros and its costs are converted to integers.

#include <benchmark/benchmark.h>
#include <random>
#include <vector>

#include "slam/association/assignment.hpp"
#if defined(AZIMUTH_HAS_DLIB)
#include <dlib/optimization/max_cost_assignment.h>
#endif

namespace azimuth {
namespace {

constexpr double kGatedShare = 0.7;
constexpr double kGatedCost = 1e4;  // expensive, but allowed, because dlib has no gates

std::vector<double> costs(int rows, int columns) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> cost(0.0, 64.0), chance(0.0, 1.0);
  std::vector<double> values(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  for (double& value : values) value = chance(engine) < kGatedShare ? kGatedCost : cost(engine);
  return values;
}

void assignment(benchmark::State& state) {
  const auto rows = static_cast<int>(state.range(0)), columns = static_cast<int>(state.range(1));
  const std::vector<double> values = costs(rows, columns);
  Assignment solver;
  std::vector<int> column_of_row;
  for (auto _ : state) {
    solver.solve({values, static_cast<std::size_t>(rows), static_cast<std::size_t>(columns)}, Objective::minimise,
                 column_of_row);
    benchmark::DoNotOptimize(column_of_row.data());
  }
}
BENCHMARK(assignment)->Args({20, 40})->Args({50, 100})->Args({200, 400})->Unit(benchmark::kMicrosecond);

#if defined(AZIMUTH_HAS_DLIB)
void dlib_assignment(benchmark::State& state) {
  const auto rows = static_cast<int>(state.range(0)), columns = static_cast<int>(state.range(1));
  const std::vector<double> values = costs(rows, columns);
  dlib::matrix<long long> profit(columns, columns);
  profit = 0;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      profit(r, c) = -static_cast<long long>(1e6 * values[static_cast<std::size_t>(r * columns + c)]);
  for (auto _ : state) benchmark::DoNotOptimize(dlib::max_cost_assignment(profit));
}
BENCHMARK(dlib_assignment)->Args({20, 40})->Args({50, 100})->Args({200, 400})->Unit(benchmark::kMicrosecond);
#endif

}  // namespace
}  // namespace azimuth
