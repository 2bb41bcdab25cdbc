#include "tools/lens_fit/lens_fit.hpp"

#include <algorithm>
#include <utility>

#include "tools/lens_fit/lens_equations.hpp"

namespace azimuth {

double LensSolution::rms_px() const { return azimuth::rms_px(error_px, fits); }

double LensSolution::fitting() const { return share(fits); }

std::optional<LensSolution> fit_lens(const LensDrive& drive, const LensSolution& start, const LensPriors& priors) {
  auto found = settled(
      start, [&](const LensSolution& at) { return lens_equations(drive, at, start, priors); }, lens_moved);
  if (!found) return std::nullopt;
  const auto covariance = leading_covariance(found->equations, kThroughout);
  if (!covariance) return std::nullopt;
  LensSolution& solution = found->at;
  const double unknowns = 3.0 * static_cast<double>(solution.lamps.size()) + kLensNumbers;
  SightingWeights weights = weigh(found->equations.mahalanobis2, unknowns);
  solution.error_px = std::move(found->equations.error_px);
  solution.fits = std::move(weights.fits);
  solution.unit_variance = std::max(1.0, weights.unit_variance);
  solution.covariance = solution.unit_variance * *covariance;
  return std::move(solution);
}

}  // namespace azimuth
