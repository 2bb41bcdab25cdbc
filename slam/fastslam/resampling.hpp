#pragma once
#include <cstddef>
#include <span>

namespace azimuth {

/// Replaces logarithms of weights by weights that sum to 1; their largest may be anything. Returns N_eff, the number of
/// equal weights that would be worth as much.
double normalise(std::span<const double> log_weights, std::span<double> weights);

/// Low variance resampling (SPEC II.9): which particle each of the new ones copies, in ascending order.
/// `start` is in [0, 1 / M), M the number of particles, and the weights sum to 1.
void low_variance(std::span<const double> weights, double start, std::span<std::size_t> source);

}  // namespace azimuth
