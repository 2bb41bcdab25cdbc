#include "tools/board_fit/board_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tools/board_fit/board_equations.hpp"

namespace azimuth {
namespace {

constexpr double kLeastSigma_px = 0.01;
constexpr double kFirstSigma_px = 3.0;  // initial corner noise, while the lens is inaccurate
constexpr int kRounds = 4;              // each round estimates the corner noise again

/// Standard deviation along one axis from the median of the distances: half of all distances are below 1.1774 standard
/// deviations.
double robust_sigma_px(std::vector<double> error_px) {
  std::erase_if(error_px, [](double each) { return !std::isfinite(each); });
  if (error_px.empty()) return kFirstSigma_px;
  const auto middle = error_px.begin() + as_index(error_px.size() / 2);
  std::nth_element(error_px.begin(), middle, error_px.end());
  return std::max(kLeastSigma_px, *middle / 1.1774);
}

}  // namespace

double BoardSolution::rms_px() const { return azimuth::rms_px(error_px, fits); }

double BoardSolution::fitting() const { return share(fits); }

std::optional<BoardSolution> fit_boards(const Chessboard& board, const std::vector<BoardSighting>& sightings,
                                        const BoardSolution& start) {
  BoardSolution solution = start;
  solution.sigma_px = kFirstSigma_px;
  const auto equations_at = [&](const BoardSolution& at) { return board_equations(board, sightings, at); };
  FitEquations equations;
  for (int round = 0; round < kRounds; ++round) {
    auto found = settled(std::move(solution), equations_at, board_moved);
    if (!found) return std::nullopt;
    solution = std::move(found->at);
    equations = std::move(found->equations);
    if (round + 1 < kRounds) solution.sigma_px = robust_sigma_px(equations.error_px);
  }
  const auto covariance = leading_covariance(equations, kLensNumbers);
  if (!covariance) return std::nullopt;
  const double unknowns = 6.0 * static_cast<double>(sightings.size()) + kLensNumbers - 1;
  SightingWeights weights = weigh(equations.mahalanobis2, unknowns);
  solution.sigma_px *= std::sqrt(weights.unit_variance);
  solution.covariance = weights.unit_variance * *covariance;
  solution.covariance.row(kLensNumbers - 1).setZero();
  solution.covariance.col(kLensNumbers - 1).setZero();
  solution.error_px = std::move(equations.error_px);
  solution.fits = std::move(weights.fits);
  return solution;
}

}  // namespace azimuth
