#pragma once
#include <cstddef>
#include <span>

namespace azimuth {

/// Converts log-weights with an arbitrary offset to weights that sum to 1. Returns N_eff, the effective number of
/// particles.
double normalise(std::span<const double> log_weights, std::span<double> weights);

/// Low-variance resampling (mathematics II.9): writes for each new particle the index of the particle that it copies,
/// in ascending order. `start` is in [0, 1 / M), where M is the number of particles; the weights must sum to 1.
void low_variance(std::span<const double> weights, double start, std::span<std::size_t> source);

}  // namespace azimuth
