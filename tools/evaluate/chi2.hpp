#pragma once
#include <cstddef>

namespace azimuth {

/// Quantile of the chi-squared distribution with `freedom` degrees of freedom. `freedom` is at least 1, `probability`
/// is in (0, 1). The relative error is at most 1e-9. Reentrant.
double chi2_quantile(double probability, std::size_t freedom);

}  // namespace azimuth
