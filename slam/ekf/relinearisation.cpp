#include "slam/ekf/relinearisation.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "slam/ekf/invariant_motion.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

// Iterate until the step is this small relative to the standard deviation; smaller linearisation errors do not matter.
constexpr double kSettledSigmas = 0.01;
// A correction of more than this many prior standard deviations has left the region that the prior describes.
constexpr double kRunawaySigmas = 6.0;

Eigen::Vector2d pair(const std::vector<double>& values, Index i) {
  return {values[as_size(i)], values[as_size(i) + 1]};
}

std::span<const ObservationRow::Part> parts(const ObservationRow& row) {
  return {row.parts.data(), as_size(row.count)};
}

}  // namespace

bool Relinearisation::settle(const JointState& state, std::span<const MappedSighting> sightings,
                             const CameraOffsets& offsets, const Settings& settings, Rows& rows) {
  linearise_at_prior(state, sightings, offsets, settings, rows);
  const double heading_variance = state.covariance(JointState::kHeading, JointState::kHeading);
  const double limit_rad = settings.iterate_below_heading_rad;
  if (settings.max_iterations <= 1 || heading_variance > limit_rad * limit_rad) return true;
  collect(state, rows);
  bool settled = false;
  for (int iteration = 0; iteration < settings.max_iterations && !settled; ++iteration) {
    double change = 0.0;
    if (!step(rows, change)) break;
    move_mean(settings.retraction);
    if (!refer_to_prior(sightings, offsets, settings, rows)) break;
    settled = change < kSettledSigmas || iteration + 1 == settings.max_iterations;
  }
  if (!settled) linearise_at_prior(state, sightings, offsets, settings, rows);
  return settled;
}

void Relinearisation::linearise_at_prior(const JointState& state, std::span<const MappedSighting> sightings,
                                         const CameraOffsets& offsets, const Settings& settings, Rows& rows) const {
  rows.clear();
  const auto at_prior = [&](Index entry) { return state.mean(entry); };
  for (const MappedSighting& sighting : sightings) {
    const auto row = linearise(sighting, offsets, settings.min_distance_m, at_prior);
    assert(row);  // the caller passes usable bearings only
    rows.push_back(*row);
  }
}

/// Copies the prior mean and covariance of the entries that the rows involve.
void Relinearisation::collect(const JointState& state, const Rows& rows) {
  entries_.clear();
  for (Index i = 0; i < 3; ++i) entries_.push_back(JointState::kPose + i);
  for (const ObservationRow& row : rows)
    for (const auto& part : parts(row))
      for (Index i = 0; i < part.size; ++i) entries_.push_back(part.offset + i);
  std::sort(entries_.begin(), entries_.end());
  entries_.erase(std::unique(entries_.begin(), entries_.end()), entries_.end());
  local_of_.resize(std::max(local_of_.size(), as_size(state.extent())));
  is_x_.resize(entries_.size());
  prior_.resize(entries_.size());
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    local_of_[as_size(entries_[i])] = as_index(i);
    is_x_[i] = state.is_position(entries_[i]);
    prior_[i] = state.mean(entries_[i]);
  }
  free_ = as_size(std::ranges::lower_bound(entries_, state.held_from()) - entries_.begin());
  mean_ = prior_;
  delta_.assign(entries_.size(), 0.0);
  const auto size = as_index(entries_.size());
  state.covariance(entries_, entries_, P_.matrix(size, size));
}

/// delta <- P H^T S^-1 innovation; `change` is the step's length in standard deviations of the prior.
bool Relinearisation::step(const Rows& rows, double& change) {
  const auto count = as_index(rows.size()), size = as_index(entries_.size());
  const auto P = P_.matrix(size, size);
  auto PHt = PHt_.matrix(size, count), S = S_.matrix(count, count);
  auto innovation = innovation_.vector(count);
  PHt.setZero();
  for (Index r = 0; r < count; ++r)
    for (const auto& part : parts(rows[as_size(r)]))
      for (Index i = 0; i < part.size; ++i) PHt.col(r) += part.coefficients[as_size(i)] * P.col(local(part.offset) + i);
  for (Index r = 0; r < count; ++r) {
    const ObservationRow& row = rows[as_size(r)];
    for (Index c = 0; c < count; ++c) {
      S(r, c) = r == c ? row.variance : 0.0;
      for (const auto& part : parts(row))
        for (Index i = 0; i < part.size; ++i) S(r, c) += part.coefficients[as_size(i)] * PHt(local(part.offset) + i, c);
    }
    innovation(r) = row.innovation;
  }
  Eigen::Ref<Eigen::MatrixXd> in_place(S);
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(in_place);
  if (factor.info() != Eigen::Success) return false;
  factor.solveInPlace(innovation);
  change = 0.0;
  for (Index i = 0; i < as_index(free_); ++i) {
    double& delta = delta_[as_size(i)];
    const double target = PHt.row(i).dot(innovation), sigma = std::sqrt(P(i, i));
    if (std::abs(target) > kRunawaySigmas * sigma) return false;
    if (sigma > 0.0) change = std::max(change, std::abs(target - delta) / sigma);
    delta = target;
  }
  return true;
}

/// Computes the mean after the correction delta, as JointState::update() will.
void Relinearisation::move_mean(JointState::Retraction retraction) {
  const bool invariant = retraction == JointState::Retraction::invariant;
  const InvariantMotion turn(delta_[as_size(local(JointState::kHeading))]);
  for (std::size_t i = 0; i < mean_.size(); ++i) {
    mean_[i] = prior_[i] + delta_[i];
    if (!invariant || is_x_[i] == 0) continue;
    const Eigen::Vector2d moved = turn.apply(pair(prior_, as_index(i)), pair(delta_, as_index(i)));
    mean_[i] = moved.x();
    mean_[++i] = moved.y();
  }
}

/// Computes rows at the present iterate q, expressed in corrections of the prior q0: innovation + H delta. In the
/// invariant case the error is unchanged when the mean moves, d(position) = d(correction) + (q - q0)_perp d(turn), just
/// as JointState::update() carries the covariance. The derivative of the exponential differs from this by half the
/// turn, which the limit on the heading's uncertainty keeps small.
bool Relinearisation::refer_to_prior(std::span<const MappedSighting> sightings, const CameraOffsets& offsets,
                                     const Settings& settings, Rows& rows) {
  const auto at_iterate = [&](Index entry) { return mean_[as_size(local(entry))]; };
  for (std::size_t k = 0; k < sightings.size(); ++k) {
    auto row = linearise(sightings[k], offsets, settings.min_distance_m, at_iterate);
    if (!row) return false;
    if (settings.retraction == JointState::Retraction::invariant) {
      double by_turn = 0.0;
      for (const auto& part : parts(*row)) {
        const Index i = local(part.offset);
        if (is_x_[as_size(i)] == 0) continue;
        const Eigen::Vector2d turned = perpendicular(pair(mean_, i) - pair(prior_, i));
        by_turn += part.coefficients[0] * turned.x() + part.coefficients[1] * turned.y();
      }
      row->add(JointState::kHeading, {&by_turn, 1});
    }
    for (const auto& part : parts(*row))
      for (Index i = 0; i < part.size; ++i)
        row->innovation += part.coefficients[as_size(i)] * delta_[as_size(local(part.offset) + i)];
    rows[k] = *row;
  }
  return true;
}

}  // namespace azimuth
