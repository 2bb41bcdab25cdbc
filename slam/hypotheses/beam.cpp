#include "slam/hypotheses/beam.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace azimuth {
namespace {

// Two members have the robot at different places beyond this, by 3 degrees of freedom (99 %).
constexpr double kElsewhereChi2 = 11.34;

Eigen::Vector3d difference(const Pose2& from, const Pose2& to) {
  return {to.x_m - from.x_m, to.y_m - from.y_m, wrap(to.heading_rad - from.heading_rad)};
}

}  // namespace

Beam::Beam(const BeamSettings& settings) : settings_(settings), gap_(std::numeric_limits<double>::infinity()) {
  for (const MemberSettings& member : differing_members(settings.members))
    members_.emplace_back(settings.hypothesis, member);
  energies_.assign(members_.size(), 0.0);
  weights_.assign(members_.size(), 1.0 / static_cast<double>(members_.size()));
  newest_covariances_.assign(members_.size(), Eigen::Matrix3d::Zero());
}

void Beam::begin(std::span<const Sighting> sightings) {
  for (Hypothesis& member : members_) member.begin(sightings);
}

void Beam::add_image(const Motion& motion, std::span<const Sighting> sightings, Workers& workers) {
  workers.for_each(members_.size(), [&](std::size_t i) {
    members_[i].add_image(motion, sightings);
    energies_[i] = members_[i].energy();
    newest_covariances_[i] = members_[i].smoother().newest_covariance();
  });
  if (images() % settings_.images_between_resampling == 0) resample();
  weigh();
  newest_ = mixture(images() - 1, newest_covariances_);
  measure_gap();
}

void Beam::resample() {
  std::vector<std::size_t> order(members_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return energies_[a] < energies_[b]; });
  const auto gone = static_cast<std::size_t>(settings_.resampled_share * static_cast<double>(order.size()));
  for (std::size_t i = 0; i < gone; ++i) {
    const std::size_t from = order.front(), to = order[order.size() - 1 - i];
    members_[to].adopt(members_[from]);
    energies_[to] = members_[to].energy();
    newest_covariances_[to] = newest_covariances_[from];
  }
}

void Beam::weigh() {
  best_ = static_cast<std::size_t>(std::min_element(energies_.begin(), energies_.end()) - energies_.begin());
  double sum = 0.0;
  for (std::size_t i = 0; i < members_.size(); ++i)
    sum += weights_[i] = std::exp(-(energies_[i] - energies_[best_]) / settings_.temperature);
  for (double& weight : weights_) weight /= sum;
}

Beam::PoseBelief Beam::pose(PoseId id) const {
  std::vector<Eigen::Matrix3d> covariances;
  for (const Hypothesis& member : members_) covariances.push_back(member.smoother().pose_covariance(id));
  return mixture(id, covariances);
}

/// Mean and covariance: what each member says of itself, and how far they are apart.
Beam::PoseBelief Beam::mixture(PoseId id, std::span<const Eigen::Matrix3d> covariances) const {
  const Pose2& centre = best().graph().pose(id);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < members_.size(); ++i)
    mean += weights_[i] * difference(centre, members_[i].graph().pose(id));
  PoseBelief belief;
  belief.T_map_body = {centre.x_m + mean.x(), centre.y_m + mean.y(), wrap(centre.heading_rad + mean.z())};
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const Eigen::Vector3d off = difference(centre, members_[i].graph().pose(id)) - mean;
    belief.covariance += weights_[i] * (covariances[i] + off * off.transpose());
  }
  return belief;
}

void Beam::measure_gap() {
  gap_ = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const Eigen::Vector3d off = difference(best().smoother().newest_pose(), members_[i].smoother().newest_pose());
    const Eigen::Matrix3d P = newest_covariances_[best_] + newest_covariances_[i];
    if (off.dot(P.ldlt().solve(off)) > kElsewhereChi2) gap_ = std::min(gap_, energies_[i] - energies_[best_]);
  }
}

}  // namespace azimuth
