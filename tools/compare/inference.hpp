#pragma once
// How sure a difference is.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace azimuth {

/// What was not measured, and what cannot be said.
inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// A mean and where it may lie; not a number where there is too little to tell.
struct MeanInterval {
  double mean;
  double low, high;  ///< 95 %
  std::size_t count = 0;
};

/// The mean of `values`, with the percentiles 2.5 and 97.5 of the means of 4000 samples drawn from them with
/// replacement. The same values and seed give the same bits on every machine. Below two values there is no interval.
MeanInterval bootstrap_mean(std::span<const double> values, std::uint64_t seed = 1);

/// Mean and variance (unbiased; 0 of a single one) of what is not empty.
struct Spread {
  double mean, variance;
  std::size_t count;
};
Spread spread(std::span<const double> values);

/// How probable a difference of means as large as `b` over `a`, or larger, is by scatter alone: Welch's test,
/// one-sided. Not a number when neither has two values; 0 or 1 when nothing scatters.
double chance_of_rise(const Spread& a, const Spread& b);

/// P(T > t) of Student's distribution with `degrees` > 0 degrees of freedom.
double student_tail(double t, double degrees);

}  // namespace azimuth
