#pragma once
#include <algorithm>
#include <benchmark/benchmark.h>
#include <vector>

namespace azimuth::bench {

/// Sets the counters median_us, p99_us and max_us.
inline void count_quantiles(benchmark::State& state, std::vector<double> times_us) {
  if (times_us.empty()) return;
  std::sort(times_us.begin(), times_us.end());
  const auto quantile = [&](double fraction) {
    return times_us[static_cast<std::size_t>(fraction * static_cast<double>(times_us.size() - 1))];
  };
  state.counters["median_us"] = quantile(0.5);
  state.counters["p99_us"] = quantile(0.99);
  state.counters["max_us"] = times_us.back();
}

}  // namespace azimuth::bench
