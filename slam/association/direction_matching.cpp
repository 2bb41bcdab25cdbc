#include "slam/association/direction_matching.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/association/chi_square.hpp"
#include "slam/association/fit_storage.hpp"
#include "slam/geometry/angle.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr int kMostRounds = 4;

bool may_be(Identity a, Identity b) { return a == kUnknownIdentity || b == kUnknownIdentity || a == b; }

}  // namespace

void DirectionMatching::match(std::span<const MeasuredDirection> measured, const PredictedOffsets& predicted,
                              const DirectionGates& gates, std::vector<DirectionMatch>& out) {
  measured_ = measured;
  predicted_ = &predicted;
  gates_ = gates;
  find_pairs();
  tries_.clear();
  choices_.clear();
  hypothesis_.forget_operations();
  try_from(nullptr);
  int tried = 0;
  for (const DirectionPair& pair : pairs_)
    if (is_disputed(pair) && tried++ < gates.max_hypotheses && hypothesis_.operations() < gates.max_operations)
      try_from(&pair);
  choose(out);
}

/// Pairs are sorted by likelihood, so that the most promising ones are tried if there are too many.
void DirectionMatching::find_pairs() {
  pairs_.clear();
  fit(pairs_of_seen_, measured_.size(), 0);
  fit(pairs_of_landmark_, predicted_->m.size(), 0);
  for (int s = 0; s < static_cast<int>(measured_.size()); ++s)
    for (int l = 0; l < static_cast<int>(predicted_->m.size()); ++l) {
      const MeasuredDirection& measured = measured_[as_size(s)];
      if (!predicted_->identity.empty() && !may_be(measured.identity, predicted_->identity[as_size(l)])) continue;
      const auto residual = measured.seen.against(predicted_->m[as_size(l)]);
      if (!residual) continue;
      DirectionPair pair{
          .seen = s, .landmark = l, .innovation = residual->innovation, .by_offset = residual->by_offset};
      pair.S = pair.by_offset * predicted_->covariance.block<2, 2>(2 * l, 2 * l) * pair.by_offset.transpose();
      pair.S.diagonal() += measured.seen.variance();
      pair.judge();
      if (!(pair.distance2 < gates_.individual_chi2)) continue;
      pairs_.push_back(pair);
      ++pairs_of_seen_[as_size(s)];
      ++pairs_of_landmark_[as_size(l)];
    }
  std::ranges::sort(pairs_, [](const DirectionPair& a, const DirectionPair& b) {
    if (a.log_likelihood != b.log_likelihood) return a.log_likelihood > b.log_likelihood;
    return a.seen != b.seen ? a.seen < b.seen : a.landmark < b.landmark;
  });
}

bool DirectionMatching::is_disputed(const DirectionPair& pair) const {
  return pairs_of_seen_[as_size(pair.seen)] > 1 || pairs_of_landmark_[as_size(pair.landmark)] > 1;
}

/// Builds one hypothesis. An assigned pair that contradicts pairs accepted before it is assigned again, conditioned on
/// the accepted pairs.
void DirectionMatching::try_from(const DirectionPair* seed) {
  hypothesis_.start(*predicted_, measured_.size());
  fit(landmark_of_, measured_.size(), kNoLandmark);
  fit(taken_, predicted_->m.size(), std::uint8_t{0});
  if (seed != nullptr) take(*seed);
  for (int round = 0; round < kMostRounds && assign_the_rest(); ++round) believe_in_order();
  keep();
}

void DirectionMatching::take(const DirectionPair& pair) {
  if (!hypothesis_.believe(pair)) return;
  landmark_of_[as_size(pair.seen)] = pair.landmark;
  taken_[as_size(pair.landmark)] = 1;
}

/// Finds the best assignment of free directions and landmarks. Returns false if nothing more can be paired.
bool DirectionMatching::assign_the_rest() {
  const std::size_t rows = measured_.size(), columns = predicted_->m.size();
  fit(table_, rows * columns, -std::numeric_limits<double>::infinity());
  fit(alone_, rows, std::log(gates_.new_density_per_sr));
  bool any = false;
  for (const DirectionPair& pair : pairs_) {
    if (landmark_of_[as_size(pair.seen)] != kNoLandmark || taken_[as_size(pair.landmark)] != 0) continue;
    const DirectionPair conditional = hypothesis_.given(pair);
    if (!(conditional.distance2 < gates_.individual_chi2)) continue;
    table_[as_size(pair.seen) * columns + as_size(pair.landmark)] = conditional.log_likelihood;
    any = true;
  }
  if (!any) return false;
  fit(column_of_row_, rows, kUnassigned);
  assignment_.solve({table_, rows, columns}, alone_, Objective::maximise, column_of_row_);
  assigned_.clear();
  for (const DirectionPair& pair : pairs_)
    if (column_of_row_[as_size(pair.seen)] == pair.landmark) assigned_.push_back(pair);
  return !assigned_.empty();
}

/// Accepts the assigned pairs in the order of pairs_, the most likely ones first.
void DirectionMatching::believe_in_order() {
  for (const DirectionPair& pair : assigned_)
    if (hypothesis_.given(pair).distance2 < gates_.individual_chi2) take(pair);
}

void DirectionMatching::keep() {
  const auto unexplained = static_cast<double>(measured_.size() - hypothesis_.believed().size());
  tries_.push_back({hypothesis_.log_likelihood() + unexplained * std::log(gates_.new_density_per_sr), choices_.size()});
  if (choices_.capacity() < choices_.size() + landmark_of_.size()) choices_.reserve(2 * choices_.size() + 64);
  choices_.insert(choices_.end(), landmark_of_.begin(), landmark_of_.end());
}

void DirectionMatching::choose(std::vector<DirectionMatch>& out) {
  fit(out, measured_.size(), DirectionMatch{});
  const auto best = std::ranges::max_element(tries_, {}, &Try::log_likelihood);
  hypothesis_.start(*predicted_, measured_.size());
  for (const DirectionPair& pair : pairs_) {
    if (choices_[best->first + as_size(pair.seen)] != pair.landmark || !hypothesis_.believe(pair)) continue;
    out[as_size(pair.seen)] = {DirectionFate::paired, pair.landmark};
  }
  refuse_explained(out);
  mark_rivals(*best, out);
  refuse_incompatible(out);
}

/// A direction that a landmark would explain must not start a new landmark.
void DirectionMatching::refuse_explained(std::vector<DirectionMatch>& out) {
  for (const DirectionPair& pair : pairs_) {
    DirectionMatch& match = out[as_size(pair.seen)];
    if (match.fate != DirectionFate::fresh) continue;
    if (hypothesis_.given(pair).distance2 < gates_.individual_chi2) match.fate = DirectionFate::refused;
  }
}

void DirectionMatching::mark_rivals(const Try& best, std::vector<DirectionMatch>& out) const {
  for (const Try& rival : tries_) {
    if (!(rival.log_likelihood > best.log_likelihood - gates_.rival_log_ratio)) continue;
    for (std::size_t s = 0; s < out.size(); ++s)
      if (choices_[rival.first + s] != choices_[best.first + s]) out[s] = {DirectionFate::ambiguous, kNoLandmark};
  }
}

void DirectionMatching::refuse_incompatible(std::vector<DirectionMatch>& out) {
  const auto believed = hypothesis_.believed();
  const auto size = static_cast<int>(2 * believed.size());
  if (believed.size() < 2) return;
  if (hypothesis_.distance2() <= chi_square_quantile(size, gates_.joint_probability)) return;
  auto S = S_.matrix(size, size);
  if (innovations_.capacity() < as_size(size)) innovations_.reserve(2 * as_size(size));
  innovations_.clear();
  for (std::size_t r = 0; r < believed.size(); ++r) {
    const DirectionPair& a = believed[r];
    innovations_.insert(innovations_.end(), {a.innovation.x(), a.innovation.y()});
    for (std::size_t c = 0; c < believed.size(); ++c) {
      const DirectionPair& b = believed[c];
      const Eigen::Matrix2d C = predicted_->covariance.block<2, 2>(2 * a.landmark, 2 * b.landmark);
      S.block<2, 2>(2 * as_index(r), 2 * as_index(c)) =
          r == c ? a.S : Eigen::Matrix2d(a.by_offset * C * b.by_offset.transpose());
    }
  }
  joint_test_.prune(innovations_, 2, S, gates_.joint_probability, accepted_);
  for (std::size_t k = 0; k < believed.size(); ++k)
    if (accepted_[k] == 0) out[as_size(believed[k].seen)] = {DirectionFate::refused, kNoLandmark};
}

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
