#include "slam/hypotheses/beam.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "slam/hypotheses/scene.hpp"

namespace azimuth {
namespace {

// Threshold beyond which two members count as having the robot at different poses (99 % for three degrees of freedom).
constexpr double kElsewhereChi2 = 11.34;

}  // namespace

BeamSettings beam_settings_for(double sigma_bearing_rad, double field_of_view_rad) {
  BeamSettings settings;
  settings.hypothesis = hypothesis_settings_for(sigma_bearing_rad, field_of_view_rad);
  if (settings.hypothesis.tracks.used) {
    settings.members = 8;
    settings.images_between_resampling = 0;
    settings.images_between_loops = 0;
    settings.temperature = 1e6;
  }
  return settings;
}

Beam::Beam(const BeamSettings& settings) : settings_(settings), gap_(std::numeric_limits<double>::infinity()) {
  for (const MemberSettings& member : differing_members(settings.members))
    members_.emplace_back(settings.hypothesis, member);
  energies_.assign(members_.size(), 0.0);
  weights_.assign(members_.size(), 1.0 / static_cast<double>(members_.size()));
  newest_covariances_.assign(members_.size(), Eigen::Matrix3d::Zero());
}

void Beam::remember(const MapSnapshot& map, const Eigen::Matrix3d& moved) {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    members_[i].remember(map, moved);
    members_[i].begin({});
    newest_covariances_[i] = members_[i].smoother().newest_covariance();
  }
  conclude_image();
}

void Beam::begin(std::span<const NamelessSighting> sightings) {
  for (Hypothesis& member : members_) member.begin(sightings);
}

void Beam::add_image(const Motion& motion, std::span<const NamelessSighting> sightings, Workers& workers,
                     double after_s) {
  const Scene scene = scene_by_experience(settings_.hypothesis.scene, best().graph(), best().landmarks());
  workers.for_each(members_.size(), [&](std::size_t i) {
    members_[i].expect(scene);
    members_[i].add_image(motion, sightings, after_s);
    if (looks_for_itself(i)) members_[i].close_loop();
    energies_[i] = members_[i].energy();
    newest_covariances_[i] = members_[i].smoother().newest_covariance();
  });
  if (settings_.images_between_resampling > 0 && images() % settings_.images_between_resampling == 0) {
    narrow();
    resample();
  }
  conclude_image();
}

bool Beam::looks_for_itself(std::size_t member) const {
  const auto turns = static_cast<std::size_t>(settings_.images_between_loops);
  return turns > 0 && (static_cast<std::size_t>(members_[member].images()) + member) % turns == 0;
}

void Beam::forget(std::span<const PoseId> images, Workers& workers) {
  workers.for_each(members_.size(), [&](std::size_t i) {
    members_[i].forget(images);
    energies_[i] = members_[i].energy();
    newest_covariances_[i] = members_[i].smoother().newest_covariance();
  });
  conclude_image();
}

void Beam::correct(const Calibration& errors, Workers& workers) {
  workers.for_each(members_.size(), [&](std::size_t i) {
    members_[i].correct(errors);
    energies_[i] = members_[i].energy();
    newest_covariances_[i] = members_[i].smoother().newest_covariance();
  });
  conclude_image();
}

void Beam::conclude_image() {
  weigh();
  std::vector<PoseBelief> newest;
  for (std::size_t i = 0; i < members_.size(); ++i)
    newest.push_back({members_[i].smoother().newest_pose(), newest_covariances_[i]});
  newest_ = azimuth::mixture(newest, weights_, newest[best_].T_map_body);
  measure_gap();
}

std::vector<std::size_t> Beam::from_best_to_worst() const {
  std::vector<std::size_t> order(members_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return energies_[a] < energies_[b]; });
  return order;
}

/// Removes the worst members when the map has grown.
void Beam::narrow() {
  const std::vector<std::size_t> order = from_best_to_worst();
  const std::size_t landmarks = std::max<std::size_t>(members_[order.front()].landmarks().size(), 1);
  const std::size_t most = std::max(static_cast<std::size_t>(settings_.most_landmarks) / landmarks,
                                    static_cast<std::size_t>(settings_.fewest_members));
  if (order.size() <= most) return;
  std::vector<std::size_t> staying(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(most));
  std::sort(staying.begin(), staying.end());
  for (std::size_t to = 0; to < staying.size(); ++to) {
    const std::size_t from = staying[to];
    if (from == to) continue;
    members_[to] = std::move(members_[from]);
    energies_[to] = energies_[from];
    newest_covariances_[to] = newest_covariances_[from];
  }
  members_.erase(members_.begin() + static_cast<std::ptrdiff_t>(most), members_.end());
  energies_.resize(most);
  weights_.resize(most);
  newest_covariances_.resize(most);
}

void Beam::resample() {
  const std::vector<std::size_t> order = from_best_to_worst();
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

Beam::PoseBelief Beam::mixture(const std::function<PoseBelief(const Hypothesis&)>& of_member) const {
  std::vector<PoseBelief> of_members;
  for (const Hypothesis& member : members_) of_members.push_back(of_member(member));
  return azimuth::mixture(of_members, weights_, of_members[best_].T_map_body);
}

void Beam::measure_gap() {
  gap_ = std::numeric_limits<double>::infinity();
  elsewhere_ = 0.0;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const Eigen::Vector3d off = pose_difference(best().smoother().newest_pose(), members_[i].smoother().newest_pose());
    const Eigen::Matrix3d P = newest_covariances_[best_] + newest_covariances_[i];
    if (off.dot(P.ldlt().solve(off)) <= kElsewhereChi2) continue;
    gap_ = std::min(gap_, energies_[i] - energies_[best_]);
    elsewhere_ += weights_[i];
  }
}

}  // namespace azimuth
