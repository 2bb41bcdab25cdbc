#include "slam/association/joint_beam.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "slam/association/joint_compatibility.hpp"
#include "slam/geometry/angle.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {

void JointBeam::search(const Problem& problem) {
  grow(problem.candidates.size(), problem.width);
  order_bearings(problem);
  now_.assign(1, {0.0, 0.0, 0, 0});
  at_ = 0;
  std::fill_n(layers_[0].choice.begin(), bearings_, kNoLandmark);
  for (const std::size_t bearing : order_) {
    branch(problem, bearing);
    carry_on(problem, bearing);
  }
}

std::span<const int> JointBeam::choices(std::size_t at) const {
  return std::span(layers_[at_].choice).subspan(now_[at].block * bearings_, bearings_);
}

void JointBeam::order_bearings(const Problem& problem) {
  surest_.assign(bearings_, std::numeric_limits<double>::infinity());
  for (std::size_t b = 0; b < bearings_; ++b)
    for (const JointCandidate& candidate : problem.candidates[b])
      surest_[b] = std::min(surest_[b], problem.covariance(candidate.landmark, candidate.landmark));
  order_.resize(bearings_);
  std::iota(order_.begin(), order_.end(), 0u);
  std::ranges::sort(
      order_, [&](std::size_t a, std::size_t b) { return surest_[a] != surest_[b] ? surest_[a] < surest_[b] : a < b; });
}

/// Creates all extensions of the partial hypotheses by this bearing.
void JointBeam::branch(const Problem& problem, std::size_t bearing) {
  children_.clear();
  for (std::size_t p = 0; p < now_.size(); ++p) {
    const Partial& partial = now_[p];
    children_.push_back({partial.log_likelihood + problem.log_new, partial.distance2, p, kNoLandmark, 0.0, 0.0});
    for (const JointCandidate& candidate : problem.candidates[bearing])
      if (!is_used(partial, candidate.landmark)) pair(problem, p, candidate, problem.variance_rad2[bearing]);
  }
}

/// Adds the partial hypothesis extended by one pair, unless that fails the joint test.
void JointBeam::pair(const Problem& problem, std::size_t parent, const JointCandidate& candidate,
                     double variance_rad2) {
  const Partial& partial = now_[parent];
  const std::span<const double> row = next_row(problem, partial, candidate.landmark);
  const double* whitened = &layers_[at_].whitened[partial.block * bearings_];
  double pivot = problem.covariance(candidate.landmark, candidate.landmark) + variance_rad2;
  double innovation = candidate.innovation;
  for (std::size_t k = 0; k < row.size(); ++k) {
    pivot -= row[k] * row[k];
    innovation -= row[k] * whitened[k];
  }
  if (!(pivot > 0.0)) return;
  const double step = innovation / std::sqrt(pivot), distance2 = partial.distance2 + step * step;
  if (distance2 > problem.quantile[row.size() + 1]) return;
  children_.push_back({partial.log_likelihood - 0.5 * (step * step + std::log(2.0 * kPi * pivot)), distance2, parent,
                       candidate.landmark, std::sqrt(pivot), step});
}

/// The most likely children form the next layer. Their rows of the factor are computed a second time, which costs less
/// than storing the rows of all children.
void JointBeam::carry_on(const Problem& problem, std::size_t bearing) {
  const auto better = [](const Child& a, const Child& b) {
    if (a.log_likelihood != b.log_likelihood) return a.log_likelihood > b.log_likelihood;
    return a.parent != b.parent ? a.parent < b.parent : a.landmark < b.landmark;
  };
  const std::size_t kept = std::min(problem.width, children_.size());
  std::partial_sort(children_.begin(), children_.begin() + static_cast<std::ptrdiff_t>(kept), children_.end(), better);
  children_.resize(kept);
  next_.clear();
  for (const Child& child : children_) write(problem, child, bearing);
  std::swap(now_, next_);
  at_ = 1 - at_;
}

void JointBeam::write(const Problem& problem, const Child& child, std::size_t bearing) {
  Layer& next = layers_[1 - at_];
  const Layer& here = layers_[at_];
  const Partial& parent = now_[child.parent];
  const std::size_t block = next_.size(), from = parent.block;
  const auto paired = as_size(parent.paired), filled = paired * (paired + 1) / 2;
  std::copy_n(&here.choice[from * bearings_], bearings_, &next.choice[block * bearings_]);
  std::copy_n(&here.row[from * bearings_], paired, &next.row[block * bearings_]);
  std::copy_n(&here.whitened[from * bearings_], paired, &next.whitened[block * bearings_]);
  std::copy_n(&here.factor[from * triangle_], filled, &next.factor[block * triangle_]);
  next_.push_back({child.log_likelihood, child.distance2, block, parent.paired});
  if (child.landmark == kNoLandmark) return;
  const std::span<const double> row = next_row(problem, parent, child.landmark);
  std::ranges::copy(row, &next.factor[block * triangle_ + filled]);
  next.factor[block * triangle_ + filled + paired] = child.pivot;
  next.whitened[block * bearings_ + paired] = child.whitened;
  next.row[block * bearings_ + paired] = child.landmark;
  next.choice[block * bearings_ + bearing] = child.landmark;
  ++next_.back().paired;
}

bool JointBeam::is_used(const Partial& partial, int landmark) const {
  const int* row = &layers_[at_].row[partial.block * bearings_];
  return std::find(row, row + partial.paired, landmark) != row + partial.paired;
}

/// Computes the next row of the Cholesky factor, without its pivot.
std::span<const double> JointBeam::next_row(const Problem& problem, const Partial& partial, int landmark) {
  const double* factor = &layers_[at_].factor[partial.block * triangle_];
  const int* row = &layers_[at_].row[partial.block * bearings_];
  const auto paired = as_size(partial.paired);
  for (std::size_t c = 0; c < paired; ++c) {
    double sum = problem.covariance(landmark, row[c]);
    for (std::size_t k = 0; k < c; ++k) sum -= solved_[k] * factor[k];
    factor += c;
    solved_[c] = sum / *factor++;
  }
  return {solved_.data(), paired};
}

void JointBeam::grow(std::size_t bearings, std::size_t width) {
  bearings_ = bearings;
  triangle_ = bearings * (bearings + 1) / 2;
  const auto at_least = [](auto& storage, std::size_t size) {
    if (storage.size() < size) storage.resize(2 * size);
  };
  for (Layer& layer : layers_) {
    at_least(layer.choice, width * bearings_);
    at_least(layer.row, width * bearings_);
    at_least(layer.whitened, width * bearings_);
    at_least(layer.factor, width * triangle_);
  }
  at_least(solved_, bearings_);
}

}  // namespace azimuth
