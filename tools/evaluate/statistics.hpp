#pragma once
#include <cstddef>
#include <limits>
#include <span>

namespace azimuth {

inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

/// Of a sequence of error magnitudes. Without any: all kNotMeasured.
struct ErrorStatistics {
  std::size_t count = 0;
  double rmse = kNotMeasured;
  double mean = kNotMeasured;
  double max = kNotMeasured;
  double final = kNotMeasured;  ///< the last one
};

ErrorStatistics error_statistics(std::span<const double> errors);

/// Of durations in microseconds. Without any: all kNotMeasured.
struct TimeStatistics {
  double median_us = kNotMeasured;
  double p99_us = kNotMeasured;
  double max_us = kNotMeasured;
  double mean_us = kNotMeasured;
};

/// Percentiles by nearest rank: each is one of the durations.
TimeStatistics time_statistics(std::span<const double> durations_us);

}  // namespace azimuth
