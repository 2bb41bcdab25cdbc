#pragma once
// Times each iteration separately: the pauses of google-benchmark cost as much as a small step, and a mean does not
// show the slowest step. The thread's CPU time serves as clock, so that other load disturbs fewer values.

#include <benchmark/benchmark.h>
#include <utility>
#include <vector>

#include "tests/bench/quantiles.hpp"
#include "tests/support/cpu_time.hpp"

namespace azimuth::bench {

/// For benchmarks with UseManualTime(): call time() around the measured part of each iteration. The destructor sets the
/// counters median_us, p99_us and max_us.
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
