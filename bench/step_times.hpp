#pragma once
// Times each iteration by itself: google-benchmark's pauses cost as much as a small step, and a mean says nothing
// about the slowest step. The clock is the thread's own CPU time, so that a busy machine spoils fewer numbers.

#include <benchmark/benchmark.h>
#include <utility>
#include <vector>

#include "bench/quantiles.hpp"
#include "tests/support/cpu_time.hpp"

namespace azimuth::bench {

/// For benchmarks with UseManualTime(): time() around what counts in each iteration; at the end the counters
/// median_us, p99_us and max_us are set.
class StepTimes {
 public:
  explicit StepTimes(benchmark::State& state) : state_(state) {}
  StepTimes(const StepTimes&) = delete;
  StepTimes& operator=(const StepTimes&) = delete;
  ~StepTimes() { count_quantiles(state_, std::move(times_us_)); }

  template <class Step>
  void time(const Step& step) {
    const double start_s = cpu_time_s();
    step();
    const double elapsed_s = cpu_time_s() - start_s;
    state_.SetIterationTime(elapsed_s);
    times_us_.push_back(1e6 * elapsed_s);
  }

 private:
  benchmark::State& state_;
  std::vector<double> times_us_;
};

}  // namespace azimuth::bench
