#include "slam/ekf/bearing_ekf.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace azimuth {
namespace {

/// Of the points seen: x and y of each, in their order.
std::vector<Index> position_entries(std::span<const MappedSighting> sightings) {
  std::vector<Index> entries;
  for (const MappedSighting& sighting : sightings)
    for (const Index i : {0, 1}) entries.push_back(sighting.landmark + i);
  return entries;
}

}  // namespace

BearingEkf::BearingEkf(const BearingEkfSettings& settings) : settings_(settings) {
  yaw_.constant_rad = settings.yaw_offset_rad;
  if (!settings.estimate_yaw) return;
  const Eigen::VectorXd mean = Eigen::VectorXd::Constant(1, settings.yaw_offset_rad);
  const Eigen::MatrixXd noise = Eigen::MatrixXd::Constant(1, 1, settings.sigma_yaw_rad * settings.sigma_yaw_rad);
  yaw_.block = state_.add(BlockKind::scalar, mean, {}, Eigen::MatrixXd(1, 0), noise);
}

void BearingEkf::predict(const Motion& motion) {
  const MovedPose moved = apply(state_.pose(), motion);
  state_.move_robot(moved.T_map_body, moved.G, moved.noise);
}

std::optional<ObservationRow> BearingEkf::linearise(const MappedSighting& sighting) const {
  return azimuth::linearise(sighting, yaw_, settings_.min_distance_m, [&](Index entry) { return state_.mean(entry); });
}

double BearingEkf::prediction_covariance(const ObservationRow& a, const ObservationRow& b) const {
  double sum = 0.0;
  for (int p = 0; p < a.count; ++p)
    for (int q = 0; q < b.count; ++q) {
      const auto& pa = a.parts[static_cast<std::size_t>(p)];
      const auto& pb = b.parts[static_cast<std::size_t>(q)];
      for (Index i = 0; i < pa.size; ++i)
        for (Index j = 0; j < pb.size; ++j)
          sum += pa.coefficients[static_cast<std::size_t>(i)] * pb.coefficients[static_cast<std::size_t>(j)] *
                 state_.covariance(pa.offset + i, pb.offset + j);
    }
  return sum;
}

bool BearingEkf::update(std::span<const MappedSighting> sightings) {
  usable_.clear();
  for (const MappedSighting& sighting : sightings)
    if (linearise(sighting)) usable_.push_back(sighting);
  const Relinearisation::Settings settings{settings_.max_iterations, settings_.iterate_below_heading_rad,
                                           settings_.min_distance_m, settings_.retraction};
  relinearisation_.settle(state_, usable_, yaw_, settings, rows_);
  return state_.update(rows_, settings_.retraction);
}

std::optional<Resection> BearingEkf::resect(std::span<const MappedSighting> sightings) const {
  std::vector<DirectionTo> directions;
  double variance_rad2 = 0.0;
  for (const MappedSighting& sighting : sightings) {
    variance_rad2 = std::max(variance_rad2, sighting.variance_rad2);
    directions.push_back({state_.position(sighting.landmark), sighting.azimuth_rad + yaw_offset_rad()});
  }
  const std::vector<Index> entries = position_entries(sightings);
  Eigen::MatrixXd P(entries.size(), entries.size());
  state_.covariance(entries, entries, P);
  return azimuth::resect(directions, P, variance_rad2, settings_.min_distance_m);
}

void BearingEkf::relocate(std::span<const MappedSighting> sightings, const Resection& found) {
  state_.replace_robot(found.T_map_body, position_entries(sightings), found.by_landmarks, found.noise);
}

Matrix6d BearingEkf::joint_pose_covariance(Index pose_i, Index pose_j) const {
  std::array<Index, 6> entries{};
  std::iota(entries.begin(), entries.begin() + 3, pose_i);
  std::iota(entries.begin() + 3, entries.end(), pose_j);
  Matrix6d P6;
  for (int c = 0; c < 6; ++c)
    for (int r = 0; r < 6; ++r)
      P6(r, c) = state_.covariance(entries[static_cast<std::size_t>(r)], entries[static_cast<std::size_t>(c)]);
  return P6;
}

Sighting BearingEkf::sighting_from(Index block, double camera_azimuth_rad) const {
  return {state_.pose(block), camera_azimuth_rad + yaw_offset_rad()};
}

Index BearingEkf::add_point(const Intersection& meeting, Index pose_i, Index pose_j, double sigma_bearing_rad) {
  std::array<Index, 7> sources{};
  std::iota(sources.begin(), sources.begin() + 3, pose_i);
  std::iota(sources.begin() + 3, sources.begin() + 6, pose_j);
  std::size_t count = 6;
  Eigen::Matrix<double, 2, 7> jacobian;
  jacobian << meeting.by_poses, meeting.by_azimuths.rowwise().sum();  // the yaw turns both rays
  if (yaw_.block) sources[count++] = *yaw_.block;
  const Eigen::Matrix2d noise =
      sigma_bearing_rad * sigma_bearing_rad * meeting.by_azimuths * meeting.by_azimuths.transpose();
  return state_.add(BlockKind::point, meeting.p_map_landmark_m, {sources.data(), count},
                    jacobian.leftCols(static_cast<Index>(count)), noise);
}

Index BearingEkf::add_ray(double camera_azimuth_rad, double sigma_bearing_rad, double inverse_distance_per_m,
                          double sigma_inverse_distance_per_m) {
  const Sighting here = sighting_from(JointState::kPose, camera_azimuth_rad);
  const Eigen::Vector4d mean(here.T_map_body.x_m, here.T_map_body.y_m,
                             wrap(here.T_map_body.heading_rad + here.azimuth_rad), inverse_distance_per_m);
  std::array<Index, 4> sources{JointState::kPose, JointState::kPose + 1, JointState::kPose + 2, 0};
  std::size_t count = 3;
  Eigen::Matrix4d jacobian = Eigen::Matrix4d::Zero();
  jacobian.topLeftCorner<3, 3>().setIdentity();
  jacobian(2, 3) = 1.0;
  if (yaw_.block) sources[count++] = *yaw_.block;
  const Eigen::Vector4d sigma(0.0, 0.0, sigma_bearing_rad, sigma_inverse_distance_per_m);
  const Eigen::Matrix4d noise = sigma.array().square().matrix().asDiagonal();
  return state_.add(BlockKind::inverse_depth, mean, {sources.data(), count},
                    jacobian.leftCols(static_cast<Index>(count)), noise);
}

InverseDepth BearingEkf::ray(Index block) const {
  return {state_.position(block), state_.mean(block + 2), state_.mean(block + 3)};
}

double BearingEkf::linearity_index(Index block) const {
  const InverseDepth landmark = ray(block);
  const double rho = landmark.inverse_distance_per_m;
  if (!(rho > 0.0)) return std::numeric_limits<double>::infinity();
  const Eigen::Vector2d from_robot = point_of(landmark) - state_.position(JointState::kPose);
  const double distance_m = from_robot.norm();
  const double cos_parallax = landmark.direction().dot(from_robot) / distance_m;
  const double sigma_distance_m = std::sqrt(state_.covariance(block + 3, block + 3)) / (rho * rho);
  return 4.0 * sigma_distance_m / distance_m * std::abs(cos_parallax);
}

void BearingEkf::promote(Index block) {
  Eigen::Matrix<double, 2, 4> jacobian;
  const Eigen::Vector2d point = point_of(ray(block), &jacobian);
  state_.promote(block, point, jacobian);
}

}  // namespace azimuth
