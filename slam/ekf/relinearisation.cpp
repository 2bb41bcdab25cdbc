#include "slam/ekf/relinearisation.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "slam/ekf/invariant_motion.hpp"

namespace azimuth {
namespace {

constexpr Index kHeading = JointState::kPose + 2;
// Iterate until the step is this small a part of its standard deviation; further linearisation error is noise.
constexpr double kSettledSigmas = 0.01;
// A correction beyond this many standard deviations of the prior has left the region the prior describes.
constexpr double kRunawaySigmas = 6.0;

}  // namespace

bool Relinearisation::settle(const JointState& state, std::span<const MappedSighting> sightings, const CameraYaw& yaw,
                             const Settings& settings, std::vector<ObservationRow>& rows) {
  const auto at_prior = [&](Index entry) { return state.mean(entry); };
  rows.clear();
  for (const MappedSighting& sighting : sightings)
    rows.push_back(*linearise(sighting, yaw, settings.min_distance_m, at_prior));
  const double heading_variance = state.covariance(kHeading, kHeading);
  const double limit_rad = settings.iterate_below_heading_rad;
  if (settings.max_iterations <= 1 || heading_variance > limit_rad * limit_rad) return true;
  collect(state, rows);
  delta_.setZero(static_cast<Index>(entries_.size()));
  bool settled = false;
  for (int iteration = 0; iteration < settings.max_iterations && !settled; ++iteration) {
    double change = 0.0;
    if (!step(rows, change)) break;
    settled = change < kSettledSigmas;
    move_mean(settings.retraction);
    if (!refer_to_prior(sightings, yaw, settings, rows)) break;
    if (settled || iteration + 1 == settings.max_iterations) return true;
  }
  rows.clear();
  for (const MappedSighting& sighting : sightings)
    rows.push_back(*linearise(sighting, yaw, settings.min_distance_m, at_prior));
  return false;
}

void Relinearisation::collect(const JointState& state, std::span<const ObservationRow> rows) {
  entries_.clear();
  for (Index i = 0; i < 3; ++i) entries_.push_back(JointState::kPose + i);
  for (const ObservationRow& row : rows)
    for (int p = 0; p < row.count; ++p)
      for (Index i = 0; i < row.parts[static_cast<std::size_t>(p)].size; ++i)
        entries_.push_back(row.parts[static_cast<std::size_t>(p)].offset + i);
  std::sort(entries_.begin(), entries_.end());
  entries_.erase(std::unique(entries_.begin(), entries_.end()), entries_.end());
  local_of_.resize(std::max(local_of_.size(), static_cast<std::size_t>(state.extent())));
  is_x_.assign(entries_.size(), 0);
  const Index size = static_cast<Index>(entries_.size());
  prior_.resize(size);
  for (Index i = 0; i < size; ++i) {
    const Index entry = entries_[static_cast<std::size_t>(i)];
    local_of_[static_cast<std::size_t>(entry)] = i;
    is_x_[static_cast<std::size_t>(i)] = state.is_position(entry);
    prior_(i) = state.mean(entry);
  }
  P_.resize(size, size);
  state.covariance(entries_, entries_, P_);
  mean_ = prior_;
}

/// delta <- P H^T S^-1 innovation; `change` is the step's length in standard deviations of the prior.
bool Relinearisation::step(std::span<const ObservationRow> rows, double& change) {
  const Index count = static_cast<Index>(rows.size()), size = P_.rows();
  H_.setZero(count, size);
  Eigen::VectorXd& innovation = step_;
  innovation.resize(count);
  for (Index r = 0; r < count; ++r) {
    const ObservationRow& row = rows[static_cast<std::size_t>(r)];
    for (int p = 0; p < row.count; ++p)
      for (Index i = 0; i < row.parts[static_cast<std::size_t>(p)].size; ++i)
        H_(r, local(row.parts[static_cast<std::size_t>(p)].offset + i)) +=
            row.parts[static_cast<std::size_t>(p)].coefficients[static_cast<std::size_t>(i)];
    innovation(r) = row.innovation;
  }
  PHt_.noalias() = P_ * H_.transpose();
  S_.noalias() = H_ * PHt_;
  for (Index r = 0; r < count; ++r) S_(r, r) += rows[static_cast<std::size_t>(r)].variance;
  Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(S_);
  if (factor.info() != Eigen::Success) return false;
  factor.solveInPlace(innovation);
  change = 0.0;
  for (Index i = 0; i < size; ++i) {
    const double target = PHt_.row(i).dot(innovation), sigma = std::sqrt(P_(i, i));
    if (sigma > 0.0) change = std::max(change, std::abs(target - delta_(i)) / sigma);
    if (std::abs(target) > kRunawaySigmas * sigma) return false;
    delta_(i) = target;
  }
  return true;
}

/// The mean after the correction delta, as JointState::update() will make it.
void Relinearisation::move_mean(JointState::Retraction retraction) {
  mean_ = prior_ + delta_;
  if (retraction != JointState::Retraction::invariant) return;
  const InvariantMotion turn(delta_(local(kHeading)));
  for (Index i = 0; i < mean_.size(); ++i)
    if (is_x_[static_cast<std::size_t>(i)]) mean_.segment<2>(i) = turn.apply(prior_.segment<2>(i), delta_.segment<2>(i));
}

/// Rows at the present iterate, expressed in corrections of the prior: innovation + H delta, and in the invariant case
/// each position's columns carried through d(q+)/d(dq), with the turn's share joined to the heading's column.
bool Relinearisation::refer_to_prior(std::span<const MappedSighting> sightings, const CameraYaw& yaw,
                                     const Settings& settings, std::vector<ObservationRow>& rows) {
  const auto at_iterate = [&](Index entry) { return mean_(local(entry)); };
  const InvariantMotion turn(delta_(local(kHeading)));
  for (std::size_t k = 0; k < sightings.size(); ++k) {
    auto row = linearise(sightings[k], yaw, settings.min_distance_m, at_iterate);
    if (!row) return false;
    if (settings.retraction == JointState::Retraction::invariant) {
      double by_turn = 0.0;
      for (int p = 0; p < row->count; ++p) {
        auto& part = row->parts[static_cast<std::size_t>(p)];
        const Index i = local(part.offset);
        if (!is_x_[static_cast<std::size_t>(i)]) continue;
        const Eigen::RowVector2d by_position(part.coefficients[0], part.coefficients[1]);
        by_turn += by_position.dot(turn.by_turn(prior_.segment<2>(i), delta_.segment<2>(i)));
        const Eigen::RowVector2d by_correction = by_position * turn.V();
        part.coefficients[0] = by_correction(0);
        part.coefficients[1] = by_correction(1);
      }
      row->add(kHeading, {&by_turn, 1});
    }
    for (int p = 0; p < row->count; ++p) {
      const auto& part = row->parts[static_cast<std::size_t>(p)];
      for (Index i = 0; i < part.size; ++i)
        row->innovation += part.coefficients[static_cast<std::size_t>(i)] * delta_(local(part.offset + i));
    }
    rows[k] = *row;
  }
  return true;
}

}  // namespace azimuth
