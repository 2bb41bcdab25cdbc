#include "slam/association/joint_compatibility.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/association/chi_square.hpp"
#include "slam/geometry/angle.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {

void JointCompatibility::associate(std::span<const MeasuredAzimuth> measured, const PredictedAzimuths& predicted,
                                   const JointGates& gates, std::vector<Pairing>& out) {
  measured_ = measured;
  predicted_ = &predicted;
  gates_ = gates;
  find_candidates(gates);
  const auto count = as_index(measured.size());
  if (L_.rows() < count) {
    L_.resize(2 * count, 2 * count);
    whitened_.resize(2 * count);
  }
  if (quantile_probability_ != gates.joint_probability) quantile_.clear();
  quantile_probability_ = gates.joint_probability;
  while (quantile_.size() <= measured.size())
    quantile_.push_back(
        quantile_.empty() ? 0.0 : chi_square_quantile(static_cast<int>(quantile_.size()), gates.joint_probability));
  // With slack, so that a slightly larger image than any before does not allocate.
  if (used_.capacity() < predicted.azimuth_rad.size()) used_.reserve(2 * predicted.azimuth_rad.size());
  if (choices_.capacity() < kMostHypotheses * measured.size()) choices_.reserve(2 * kMostHypotheses * measured.size());
  if (chosen_.capacity() < measured.size()) chosen_.reserve(2 * measured.size());
  chosen_.assign(measured.size(), kNoLandmark);
  used_.assign(predicted.azimuth_rad.size(), 0);
  choices_.resize(kMostHypotheses * measured.size());
  rows_.clear();
  kept_.clear();
  kept_.reserve(kMostHypotheses);
  nodes_ = 0;
  search(0, 0, 0.0, 0.0);
  if (nodes_ > gates.max_nodes) search_by_beam();

  out.assign(measured.size(), {});
  for (std::size_t m = 0; m < measured.size(); ++m) {
    const int best = choices(kept_.front())[m];
    for (const Hypothesis& rival : kept_)
      if (rival.log_likelihood > kept_.front().log_likelihood - gates.rival_log_ratio)
        out[m].ambiguous = out[m].ambiguous || choices(rival)[m] != best;
    if (!out[m].ambiguous) out[m].landmark = best;
  }
}

void JointCompatibility::find_candidates(const JointGates& gates) {
  const auto landmarks = static_cast<int>(predicted_->azimuth_rad.size());
  while (candidates_.size() < measured_.size()) candidates_.emplace_back().reserve(kMostHypotheses);
  best_possible_.assign(measured_.size() + 1, 0.0);
  const double log_new = std::log(gates.new_density_per_rad);
  for (std::size_t m = measured_.size(); m-- > 0;) {
    candidates_[m].clear();
    for (int l = 0; l < landmarks; ++l) {
      if (!may_be(measured_[m].kind, l)) continue;
      const double innovation = wrap(measured_[m].azimuth_rad - predicted_->azimuth_rad[as_size(l)]);
      const double variance = predicted_->covariance(l, l) + measured_[m].variance_rad2;
      if (innovation * innovation < gates.individual_chi2 * variance) candidates_[m].push_back({l, innovation});
    }
    std::sort(candidates_[m].begin(), candidates_[m].end(),
              [](const Candidate& a, const Candidate& b) { return std::abs(a.innovation) < std::abs(b.innovation); });
    // The conditional variance of an innovation is never below the measurement's own.
    const double log_certain = -0.5 * std::log(2.0 * kPi * measured_[m].variance_rad2);
    best_possible_[m] = best_possible_[m + 1] + (candidates_[m].empty() ? log_new : std::max(log_new, log_certain));
  }
}

bool JointCompatibility::may_be(Kind kind, int landmark) const {
  return predicted_->kind.empty() || same_kind(kind, predicted_->kind[as_size(landmark)]);
}

void JointCompatibility::search(std::size_t measurement, int paired, double distance2, double log_likelihood) {
  if (++nodes_ > gates_.max_nodes && !kept_.empty()) return;
  if (log_likelihood + best_possible_[measurement] < worth_keeping()) return;
  if (measurement == measured_.size()) return keep(log_likelihood, chosen_);
  for (const Candidate& candidate : candidates_[measurement]) {
    const auto landmark = as_size(candidate.landmark);
    double distance2_with = distance2, log_likelihood_with = log_likelihood;
    if (used_[landmark] != 0 || !extend(measurement, candidate, paired, distance2_with, log_likelihood_with)) continue;
    used_[landmark] = 1;
    chosen_[measurement] = candidate.landmark;
    rows_.push_back(measurement);
    search(measurement + 1, paired + 1, distance2_with, log_likelihood_with);
    rows_.pop_back();
    chosen_[measurement] = kNoLandmark;
    used_[landmark] = 0;
  }
  search(measurement + 1, paired, distance2, log_likelihood + std::log(gates_.new_density_per_rad));
}

/// Adds one row to the factor of the joint innovation covariance. Returns false when the joint test fails.
bool JointCompatibility::extend(std::size_t measurement, const Candidate& candidate, int paired, double& distance2,
                                double& log_likelihood) {
  const Eigen::Index row = paired;
  double pivot = predicted_->covariance(candidate.landmark, candidate.landmark) + measured_[measurement].variance_rad2;
  double innovation = candidate.innovation;
  for (Eigen::Index c = 0; c < row; ++c) {
    const int other = chosen_[rows_[as_size(c)]];
    double sum = predicted_->covariance(candidate.landmark, other);
    for (Eigen::Index k = 0; k < c; ++k) sum -= L_(row, k) * L_(c, k);
    L_(row, c) = sum / L_(c, c);
    pivot -= L_(row, c) * L_(row, c);
    innovation -= L_(row, c) * whitened_(c);
  }
  if (!(pivot > 0.0)) return false;
  L_(row, row) = std::sqrt(pivot);
  whitened_(row) = innovation / L_(row, row);
  const double step2 = whitened_(row) * whitened_(row);
  distance2 += step2;
  log_likelihood -= 0.5 * (step2 + std::log(2.0 * kPi * pivot));
  return distance2 <= quantile_[as_size(paired + 1)];
}

/// The log-likelihood below which a hypothesis can be neither the best nor a rival.
double JointCompatibility::worth_keeping() const {
  if (kept_.empty()) return -std::numeric_limits<double>::infinity();
  const double rival = kept_.front().log_likelihood - std::max(gates_.rival_log_ratio, gates_.keep_log_ratio);
  return kept_.size() < kMostHypotheses ? rival : std::max(rival, kept_.back().log_likelihood);
}

void JointCompatibility::keep(double log_likelihood, std::span<const int> chosen) {
  std::size_t block = kept_.size();
  if (kept_.size() == kMostHypotheses) {
    block = kept_.back().block;
    kept_.pop_back();
  }
  const Hypothesis hypothesis{log_likelihood, block};
  const auto better = [](const Hypothesis& a, const Hypothesis& b) { return a.log_likelihood > b.log_likelihood; };
  kept_.insert(std::upper_bound(kept_.begin(), kept_.end(), hypothesis, better), hypothesis);
  std::copy(chosen.begin(), chosen.end(), choices(hypothesis).begin());
}

void JointCompatibility::search_by_beam() {
  variances_.clear();
  for (const MeasuredAzimuth& measured : measured_) variances_.push_back(measured.variance_rad2);
  beam_.search({std::span(candidates_).first(measured_.size()), variances_, predicted_->covariance, quantile_,
                std::log(gates_.new_density_per_rad), gates_.beam_width});
  for (std::size_t i = 0; i < beam_.size(); ++i) {
    if (beam_.log_likelihood(i) < worth_keeping()) break;
    const auto is_known = [&](const Hypothesis& known) { return std::ranges::equal(choices(known), beam_.choices(i)); };
    if (std::ranges::none_of(kept_, is_known)) keep(beam_.log_likelihood(i), beam_.choices(i));
  }
}

std::span<const int> JointCompatibility::choices(std::size_t at) const {
  return std::span(choices_).subspan(kept_[at].block * measured_.size(), measured_.size());
}

std::span<int> JointCompatibility::choices(const Hypothesis& hypothesis) {
  return {choices_.data() + hypothesis.block * measured_.size(), measured_.size()};
}

void JointTest::prune(std::span<const double> innovations, const Eigen::Ref<const Eigen::MatrixXd>& S,
                      double joint_probability, std::vector<std::uint8_t>& accepted) {
  prune(innovations, 1, S, joint_probability, accepted);
}

void JointTest::prune(std::span<const double> innovations, int axes, const Eigen::Ref<const Eigen::MatrixXd>& S,
                      double joint_probability, std::vector<std::uint8_t>& accepted) {
  const auto size = as_index(innovations.size());
  accepted.assign(innovations.size() / as_size(axes), 1);
  auto reduced = factor_.matrix(size, size), inverse = inverse_.matrix(size, size);
  auto weighted = weighted_.vector(size);
  for (Eigen::Index left = size / axes; left > 1; --left) {
    reduced = S;
    for (Eigen::Index i = 0; i < size; ++i) {
      const bool kept = accepted[as_size(i / axes)] != 0;
      weighted(i) = kept ? innovations[as_size(i)] : 0.0;
      if (kept) continue;  // left out: uncorrelated and without innovation
      reduced.row(i).setZero();
      reduced.col(i).setZero();
      reduced(i, i) = 1.0;
    }
    Eigen::Ref<Eigen::MatrixXd> in_place(reduced);
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(in_place);
    factor.matrixL().solveInPlace(weighted);
    if (weighted.squaredNorm() <= chi_square_quantile(static_cast<int>(left) * axes, joint_probability)) return;
    factor.matrixU().solveInPlace(weighted);  // now S^-1 nu
    inverse.setIdentity();
    factor.solveInPlace(inverse);
    accepted[as_size(worst_of(weighted, inverse, axes))] = 0;
  }
}

/// Leaving pair i out reduces the squared distance by (S^-1 nu)_i^T ((S^-1)_ii)^-1 (S^-1 nu)_i.
Eigen::Index JointTest::worst_of(const Eigen::Ref<const Eigen::VectorXd>& weighted,
                                 const Eigen::Ref<const Eigen::MatrixXd>& inverse, int axes) {
  Eigen::Index worst = 0;
  if (axes == 1) {
    (weighted.array().square() / inverse.diagonal().array()).maxCoeff(&worst);
    return worst;
  }
  double most = -1.0;
  for (Eigen::Index i = 0; i < weighted.size() / 2; ++i) {
    const Eigen::Vector2d nu = weighted.segment<2>(2 * i);
    const Eigen::Matrix2d block = inverse.block<2, 2>(2 * i, 2 * i);
    const double less = nu.dot(block.inverse() * nu);
    if (!(less > most)) continue;
    most = less;
    worst = i;
  }
  return worst;
}

}  // namespace azimuth
