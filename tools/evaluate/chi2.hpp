#pragma once
#include <cstddef>

namespace azimuth {

/// The value below which a sum of `freedom` squared standard normal numbers stays with that probability. `freedom` is
/// at least 1, `probability` in (0, 1). To 1e-9, relative; reentrant.
double chi2_quantile(double probability, std::size_t freedom);

}  // namespace azimuth
