#pragma once
#include <cstddef>
#include <limits>
#include <span>

namespace azimuth {

inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

/// Statistics of a sequence of error magnitudes. All values are kNotMeasured if the sequence is empty.
struct ErrorStatistics {
  std::size_t count = 0;
  double rmse = kNotMeasured;
  double mean = kNotMeasured;
  double max = kNotMeasured;
  double final = kNotMeasured;  ///< the last error
};

ErrorStatistics error_statistics(std::span<const double> errors);

/// Statistics of durations in microseconds. All values are kNotMeasured if there are none.
struct TimeStatistics {
  double median_us = kNotMeasured;
  double p99_us = kNotMeasured;
  double max_us = kNotMeasured;
  double mean_us = kNotMeasured;
};

/// Percentiles use the nearest-rank method, so each is one of the durations.
TimeStatistics time_statistics(std::span<const double> durations_us);

/// Quantile of the chi-squared distribution with `freedom` degrees of freedom. `freedom` is at least 1, `probability`
/// is in (0, 1). The relative error is at most 1e-9. Reentrant.
double chi2_quantile(double probability, std::size_t freedom);

}  // namespace azimuth
