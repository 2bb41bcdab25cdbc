#include "slam/association/direction_hypothesis.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "slam/geometry/angle.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {

void DirectionPair::judge() {
  const double determinant = S.determinant();
  if (!(determinant > 0.0)) {
    distance2 = std::numeric_limits<double>::infinity();
    log_likelihood = -distance2;
    return;
  }
  distance2 = innovation.dot(S.inverse() * innovation);
  log_likelihood = -0.5 * (distance2 + std::log(4.0 * kPi * kPi * determinant));
}

void DirectionHypothesis::start(const PredictedOffsets& predicted, std::size_t most) {
  predicted_ = &predicted;
  believed_.clear();
  log_likelihood_ = distance2_ = 0.0;
  const auto rows = as_index(2 * most);
  if (L_.rows() >= rows) return;
  believed_.reserve(2 * most);
  L_.resize(2 * rows, 2 * rows);
  across_.resize(2 * rows, 2);
  whitened_.resize(2 * rows);
}

/// across = L^-1 (D_k C_k,pair D^T), two rows for each accepted pair.
void DirectionHypothesis::whiten_against_believed(const DirectionPair& pair) {
  for (std::size_t k = 0; k < believed_.size(); ++k) {
    const DirectionPair& other = believed_[k];
    const Eigen::Matrix2d C = predicted_->covariance.block<2, 2>(2 * other.landmark, 2 * pair.landmark);
    across_.block<2, 2>(2 * as_index(k), 0).noalias() = other.by_offset * (C * pair.by_offset.transpose());
  }
  operations_ += static_cast<std::uint64_t>(rows() * rows());
  for (Eigen::Index r = 0; r < rows(); ++r)
    for (Eigen::Index c = 0; c < 2; ++c) {
      double sum = across_(r, c);
      for (Eigen::Index k = 0; k < r; ++k) sum -= L_(r, k) * across_(k, c);
      across_(r, c) = sum / L_(r, r);
    }
}

DirectionPair DirectionHypothesis::given(const DirectionPair& pair) {
  if (believed_.empty()) return pair;
  whiten_against_believed(pair);
  DirectionPair conditional = pair;
  for (Eigen::Index k = 0; k < rows(); ++k) {
    const Eigen::Vector2d row = across_.row(k).transpose();
    conditional.innovation -= whitened_(k) * row;
    conditional.S.noalias() -= row * row.transpose();
  }
  conditional.judge();
  return conditional;
}

bool DirectionHypothesis::believe(const DirectionPair& pair) {
  const DirectionPair conditional = given(pair);
  const Eigen::Matrix2d& S = conditional.S;
  if (!(S(0, 0) > 0.0 && S.determinant() > 0.0)) return false;
  const Eigen::Index first = rows();
  for (Eigen::Index k = 0; k < first; ++k) L_.block<2, 1>(first, k) = across_.row(k).transpose();
  L_(first, first) = std::sqrt(S(0, 0));
  L_(first + 1, first) = S(1, 0) / L_(first, first);
  L_(first + 1, first + 1) = std::sqrt(S.determinant()) / L_(first, first);
  whitened_(first) = conditional.innovation.x() / L_(first, first);
  whitened_(first + 1) =
      (conditional.innovation.y() - L_(first + 1, first) * whitened_(first)) / L_(first + 1, first + 1);
  believed_.push_back(pair);
  log_likelihood_ += conditional.log_likelihood;
  distance2_ += conditional.distance2;
  return true;
}

}  // namespace azimuth
