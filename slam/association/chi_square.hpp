#pragma once

namespace azimuth {

/// The value a chi-square variable of `degrees_of_freedom` (1 or more) stays below with the given probability
/// (0.5 to 0.9999): within 1 % up to 0.99, within 4 % beyond.
double chi_square_quantile(int degrees_of_freedom, double probability);

}  // namespace azimuth
