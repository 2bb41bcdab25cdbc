#include "slam/association/joint_compatibility.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/association/chi_square.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth {

void JointCompatibility::associate(std::span<const MeasuredAzimuth> measured, const PredictedAzimuths& predicted,
                                   const JointGates& gates, std::vector<Pairing>& out) {
  measured_ = measured;
  predicted_ = &predicted;
  gates_ = gates;
  const auto landmarks = static_cast<int>(predicted.azimuth_rad.size());
  const auto count = static_cast<Eigen::Index>(measured.size());
  candidates_.resize(std::max(candidates_.size(), measured.size()));
  for (std::size_t m = 0; m < measured.size(); ++m) {
    candidates_[m].clear();
    for (int l = 0; l < landmarks; ++l) {
      const double innovation = wrap(measured[m].azimuth_rad - predicted.azimuth_rad[static_cast<std::size_t>(l)]);
      const double variance = predicted.covariance(l, l) + measured[m].variance_rad2;
      if (innovation * innovation < gates.individual_chi2 * variance) candidates_[m].push_back({l, innovation});
    }
    std::sort(candidates_[m].begin(), candidates_[m].end(), [](const Candidate& a, const Candidate& b) {
      return std::abs(a.innovation) < std::abs(b.innovation);
    });
  }
  while (quantile_.size() <= measured.size())
    quantile_.push_back(quantile_.empty() ? 0.0
                                          : chi_square_quantile(static_cast<int>(quantile_.size()), gates.joint_probability));
  if (L_.rows() < count) {
    L_.resize(count, count);
    whitened_.resize(count);
  }
  chosen_.assign(measured.size(), kNoLandmark);
  used_.assign(static_cast<std::size_t>(landmarks), false);
  rows_.clear();
  best_paired_ = rival_paired_ = -1;
  nodes_ = 0;
  search(0, 0, 0.0);

  out.assign(measured.size(), {});
  const bool rivalled = gates.ambiguity_chi2 > 0.0 && rival_paired_ == best_paired_ &&
                        rival_distance2_ - best_distance2_ < gates.ambiguity_chi2;
  for (std::size_t m = 0; m < measured.size(); ++m) {
    out[m].near_a_landmark = !candidates_[m].empty();
    out[m].ambiguous = rivalled && best_[m] != rival_[m];
    if (!out[m].ambiguous) out[m].landmark = best_[m];
  }
}

void JointCompatibility::search(std::size_t measurement, int paired, double distance2) {
  if (++nodes_ > gates_.max_nodes && best_paired_ >= 0) return;
  const int left = static_cast<int>(measured_.size() - measurement);
  const int beaten_by = gates_.ambiguity_chi2 > 0.0 ? rival_paired_ : best_paired_;
  if (paired + left < beaten_by) return;  // cannot reach a hypothesis worth keeping
  if (measurement == measured_.size()) return record(paired, distance2);
  for (const Candidate& candidate : candidates_[measurement]) {
    if (used_[static_cast<std::size_t>(candidate.landmark)]) continue;
    double extended = distance2;
    if (!extend(measurement, candidate, paired, extended)) continue;
    used_[static_cast<std::size_t>(candidate.landmark)] = true;
    chosen_[measurement] = candidate.landmark;
    rows_.push_back(measurement);
    search(measurement + 1, paired + 1, extended);
    rows_.pop_back();
    chosen_[measurement] = kNoLandmark;
    used_[static_cast<std::size_t>(candidate.landmark)] = false;
  }
  search(measurement + 1, paired, distance2);
}

/// Adds one row to the factor of the joint innovation covariance; false when the joint test fails.
bool JointCompatibility::extend(std::size_t measurement, const Candidate& candidate, int paired, double& distance2) {
  const Eigen::Index row = paired;
  double pivot = predicted_->covariance(candidate.landmark, candidate.landmark) + measured_[measurement].variance_rad2;
  double innovation = candidate.innovation;
  for (Eigen::Index c = 0; c < row; ++c) {
    const int other = chosen_[rows_[static_cast<std::size_t>(c)]];
    double sum = predicted_->covariance(candidate.landmark, other);
    for (Eigen::Index k = 0; k < c; ++k) sum -= L_(row, k) * L_(c, k);
    L_(row, c) = sum / L_(c, c);
    pivot -= L_(row, c) * L_(row, c);
    innovation -= L_(row, c) * whitened_(c);
  }
  if (!(pivot > 0.0)) return false;
  L_(row, row) = std::sqrt(pivot);
  whitened_(row) = innovation / L_(row, row);
  distance2 += whitened_(row) * whitened_(row);
  return distance2 <= quantile_[static_cast<std::size_t>(paired + 1)];
}

void JointCompatibility::record(int paired, double distance2) {
  const auto better = [&](int than_paired, double than_distance2) {
    return paired > than_paired || (paired == than_paired && distance2 < than_distance2);
  };
  if (better(best_paired_, best_distance2_)) {
    rival_ = best_;
    rival_paired_ = best_paired_;
    rival_distance2_ = best_distance2_;
    best_ = chosen_;
    best_paired_ = paired;
    best_distance2_ = distance2;
  } else if (better(rival_paired_, rival_distance2_)) {
    rival_ = chosen_;
    rival_paired_ = paired;
    rival_distance2_ = distance2;
  }
}

void JointCompatibility::prune(std::span<const double> innovations, const Eigen::Ref<const Eigen::MatrixXd>& S,
                               double joint_probability, std::vector<bool>& accepted) {
  const auto size = static_cast<Eigen::Index>(innovations.size());
  accepted.assign(innovations.size(), true);
  Eigen::MatrixXd L(size, size);
  Eigen::VectorXd weighted(size);
  for (Eigen::Index left = size; left > 1; --left) {
    L = S;
    for (Eigen::Index i = 0; i < size; ++i) weighted(i) = innovations[static_cast<std::size_t>(i)];
    for (Eigen::Index i = 0; i < size; ++i) {  // leave out: uncorrelated and without innovation
      if (accepted[static_cast<std::size_t>(i)]) continue;
      L.row(i).setZero();
      L.col(i).setZero();
      L(i, i) = 1.0;
      weighted(i) = 0.0;
    }
    Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(L);
    const Eigen::VectorXd innovation = weighted;
    factor.solveInPlace(weighted);
    const double distance2 = innovation.dot(weighted);
    if (distance2 <= chi_square_quantile(static_cast<int>(left), joint_probability)) return;
    // Leaving i out lowers the distance by (S^-1 nu)_i^2 / (S^-1)_ii.
    const Eigen::MatrixXd inverse = factor.solve(Eigen::MatrixXd::Identity(size, size));
    Eigen::Index worst = 0;
    double largest = -1.0;
    for (Eigen::Index i = 0; i < size; ++i) {
      const double drop = weighted(i) * weighted(i) / inverse(i, i);
      if (accepted[static_cast<std::size_t>(i)] && drop > largest) {
        largest = drop;
        worst = i;
      }
    }
    accepted[static_cast<std::size_t>(worst)] = false;
  }
}

}  // namespace azimuth
