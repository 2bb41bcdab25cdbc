#pragma once
// Statistical tests of differences.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace azimuth {

/// Stands for values that were not measured or that cannot be determined.
inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// A mean and its confidence interval; NaN if there are too few values.
struct MeanInterval {
  double mean;
  double low, high;  ///< limits of the 95 % interval
  std::size_t count = 0;
};

/// The mean of `values` with a bootstrap interval: the percentiles 2.5 and 97.5 of the means of 4000 samples drawn with
/// replacement. The same values and seed give the same bits on every machine. Fewer than two values give no interval.
MeanInterval bootstrap_mean(std::span<const double> values, std::uint64_t seed = 1);

/// Mean and unbiased variance of at least one value. The variance of a single value is 0.
struct Spread {
  double mean, variance;
  std::size_t count;
};
Spread spread(std::span<const double> values);

/// One-sided p-value of Welch's t-test: the probability of a rise of the mean from `a` to `b` as large as observed, or
/// larger, by scatter alone. NaN if neither side has two values; 0 or 1 if the values do not scatter.
double chance_of_rise(const Spread& a, const Spread& b);

/// P(T > t) of Student's distribution with `degrees` > 0 degrees of freedom.
double student_tail(double t, double degrees);

}  // namespace azimuth
