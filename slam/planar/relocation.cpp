#include "slam/planar/relocation.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "slam/association/chi_square.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kContradictions = 3;  // fewer rejections point to wrong landmarks rather than to a wrong pose
// Factor between variances above which the smaller one replaces the larger one.
constexpr double kMuchLarger = 9.0;
constexpr int kUnknowns = 3;  // x, y, heading
// A rival pose is ruled out only if it fails the test by this factor.
constexpr double kRivalFactor = 2.0;

}  // namespace

bool is_in_doubt(const PoseBelief& belief, std::size_t rejected, std::size_t matched,
                 const RelocationSettings& settings) {
  const Eigen::Vector3d variances = belief.covariance.diagonal();
  const bool vague =
      std::sqrt(variances.head<2>().maxCoeff()) > settings.beyond_m || std::sqrt(variances(2)) > settings.beyond_rad;
  return vague || (rejected >= kContradictions && 2 * rejected > matched);
}

bool replaces(const Resection& found, std::size_t directions, const PoseBelief& belief,
              const RelocationSettings& settings) {
  const double gate = chi_square_quantile(static_cast<int>(directions) - kUnknowns, settings.probability);
  if (found.chi2 > gate || found.rival_chi2 < kRivalFactor * gate) return false;
  const Eigen::Matrix3d &P = belief.covariance, &P_found = found.covariance;
  const bool sharper = kMuchLarger * P_found.topLeftCorner<2, 2>().trace() < P.topLeftCorner<2, 2>().trace() &&
                       kMuchLarger * P_found(2, 2) < P(2, 2);
  Eigen::Vector3d apart = found.T_map_body.vector() - belief.T_map_body.vector();
  apart.z() = wrap(apart.z());
  const bool contradicts = apart.dot((P + P_found).ldlt().solve(apart)) > settings.contradiction_chi2;
  return sharper || contradicts;
}

}  // namespace azimuth
