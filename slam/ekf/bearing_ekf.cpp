#include "slam/ekf/bearing_ekf.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "slam/ekf/curvature.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {

namespace {

/// The x and y entries of the points, in the order of the bearings.
std::vector<Index> position_entries(std::span<const MappedSighting> sightings) {
  std::vector<Index> entries;
  for (const MappedSighting& sighting : sightings)
    for (const Index i : {0, 1}) entries.push_back(sighting.landmark + i);
  return entries;
}

/// The entries of the state from which a new block is made.
class Sources {
 public:
  static constexpr Index kMost = 11;  // two poses, yaw, centre, tilt

  /// Adds the `size` entries from `block` on. Returns the Jacobian's column of the first of them.
  Index add(Index block, Index size) {
    const Index column = count_;
    for (Index i = 0; i < size; ++i) entries_[as_size(count_++)] = block + i;
    return column;
  }
  Index count() const { return count_; }
  std::span<const Index> entries() const { return {entries_.data(), as_size(count_)}; }

 private:
  std::array<Index, kMost> entries_{};
  Index count_ = 0;
};

}  // namespace

BearingEkf::BearingEkf(const BearingEkfSettings& settings) : settings_(settings) {
  offsets_.yaw_rad = settings.yaw_offset_rad;
  const auto add = [&](BlockKind kind, const Eigen::VectorXd& mean, double sigma) {
    const Index size = size_of(kind);
    return state_.add(kind, mean, {}, Eigen::MatrixXd(size, 0), sigma * sigma * Eigen::MatrixXd::Identity(size, size));
  };
  if (settings.estimate_yaw)
    offsets_.yaw_block =
        add(BlockKind::scalar, Eigen::VectorXd::Constant(1, settings.yaw_offset_rad), settings.sigma_yaw_rad);
  const bool leans = settings.sigma_tilt_rad > 0.0 && settings.profile;
  if (settings.sigma_centre_px > 0.0 || leans)
    offsets_.errors_block = add(BlockKind::plain_pair, settings.camera_errors.head<2>(), settings.sigma_centre_px);
  if (leans) {
    add(BlockKind::plain_pair, settings.camera_errors.tail<2>(), settings.sigma_tilt_rad);
    offsets_.profile = settings.profile;
  }
  state_.consider(settings.sigma_considered.cwiseAbs2());
  set_of_placed_robot(state_);
}

void BearingEkf::place_robot(const Pose2& T_map_body, const Eigen::Matrix3d& covariance) {
  state_.replace_robot(T_map_body, {}, Eigen::Matrix3Xd(3, 0), covariance);
  set_of_placed_robot(state_);
}

std::optional<CameraErrors> BearingEkf::camera_errors() const {
  if (!offsets_.errors_block) return std::nullopt;
  CameraErrors errors{offsets_.errors([&](Index entry) { return state_.mean(entry); }), Eigen::Matrix4d::Zero()};
  const Index block = *offsets_.errors_block, size = offsets_.errors_size();
  for (Index c = 0; c < size; ++c)
    for (Index r = 0; r < size; ++r) errors.covariance(r, c) = state_.covariance(block + r, block + c);
  return errors;
}

void BearingEkf::predict(const Motion& motion) { move(motion, state_); }

std::optional<ObservationRow> BearingEkf::linearise(const MappedSighting& sighting) const {
  return azimuth::linearise(sighting, offsets_, settings_.min_distance_m,
                            [&](Index entry) { return state_.mean(entry); });
}

bool BearingEkf::update(std::span<const MappedSighting> sightings) {
  usable_.clear();
  for (const MappedSighting& sighting : sightings) {
    if (!linearise(sighting)) continue;
    usable_.push_back(sighting);
    usable_.back().variance_rad2 += curvature_rad2(sighting);
  }
  const Relinearisation::Settings settings{settings_.max_iterations, settings_.iterate_below_heading_rad,
                                           settings_.min_distance_m, retraction()};
  relinearisation_.settle(state_, usable_, offsets_, settings, rows_);
  return state_.update(rows_, retraction());
}

std::optional<Resection> BearingEkf::resect(std::span<const MappedSighting> sightings) const {
  std::vector<DirectionTo> directions;
  double variance_rad2 = 0.0;
  for (const MappedSighting& sighting : sightings) {
    variance_rad2 = std::max(variance_rad2, sighting.variance_rad2);
    const Sighting seen = sighting_from(JointState::kPose, sighting.azimuth_rad, sighting.radius_px);
    directions.push_back({state_.position(sighting.landmark), seen.azimuth_rad});
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
    for (int r = 0; r < 6; ++r) P6(r, c) = state_.covariance(entries[as_size(r)], entries[as_size(c)]);
  return P6;
}

Sighting BearingEkf::sighting_from(Index block, double camera_azimuth_rad, double radius_px) const {
  const auto mean = [&](Index entry) { return state_.mean(entry); };
  return {state_.pose(block), offsets_.correct(camera_azimuth_rad, radius_px, mean).azimuth_rad};
}

Eigen::RowVector4d BearingEkf::by_camera(double camera_azimuth_rad, double radius_px) const {
  const auto mean = [&](Index entry) { return state_.mean(entry); };
  return offsets_.correct(camera_azimuth_rad, radius_px, mean).by_camera;
}

Index BearingEkf::add_point(const Intersection& meeting, Index pose_i, Index pose_j, double sigma_bearing_rad,
                            const Eigen::Matrix<double, 2, 4>& by_camera) {
  Sources sources;
  Eigen::Matrix<double, 2, Sources::kMost> jacobian;
  sources.add(pose_i, 3);
  sources.add(pose_j, 3);
  jacobian.leftCols<6>() = meeting.by_poses;
  if (offsets_.yaw_block) jacobian.col(sources.add(*offsets_.yaw_block, 1)) = meeting.by_azimuths.rowwise().sum();
  if (const Index size = offsets_.errors_size(); size > 0)
    jacobian.middleCols(sources.add(*offsets_.errors_block, size), size) =
        meeting.by_azimuths * by_camera.leftCols(size);
  const Eigen::Matrix2d noise =
      sigma_bearing_rad * sigma_bearing_rad * meeting.by_azimuths * meeting.by_azimuths.transpose();
  return state_.add(BlockKind::point, meeting.p_map_landmark_m, sources.entries(), jacobian.leftCols(sources.count()),
                    noise);
}

Index BearingEkf::add_ray(double camera_azimuth_rad, double sigma_bearing_rad, double inverse_distance_per_m,
                          double sigma_inverse_distance_per_m, double radius_px) {
  const Sighting here = sighting_from(JointState::kPose, camera_azimuth_rad, radius_px);
  const Eigen::Vector4d mean(here.T_map_body.x_m, here.T_map_body.y_m,
                             wrap(here.T_map_body.heading_rad + here.azimuth_rad), inverse_distance_per_m);
  Sources sources;
  Eigen::Matrix<double, 4, Sources::kMost> jacobian = Eigen::Matrix<double, 4, Sources::kMost>::Zero();
  sources.add(JointState::kPose, 3);
  jacobian.topLeftCorner<3, 3>().setIdentity();
  if (offsets_.yaw_block) jacobian(2, sources.add(*offsets_.yaw_block, 1)) = 1.0;
  if (const Index size = offsets_.errors_size(); size > 0)
    jacobian.row(2).segment(sources.add(*offsets_.errors_block, size), size) =
        by_camera(camera_azimuth_rad, radius_px).head(size);
  Eigen::Vector4d variance(0.0, 0.0, sigma_bearing_rad * sigma_bearing_rad,
                           sigma_inverse_distance_per_m * sigma_inverse_distance_per_m);
  if (settings_.charge_curvature) variance(2) += camera_curvature_rad2(camera_azimuth_rad, radius_px);
  const Eigen::Matrix4d noise = variance.asDiagonal();
  return state_.add(BlockKind::inverse_depth, mean, sources.entries(), jacobian.leftCols(sources.count()), noise);
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

bool BearingEkf::may_be_one(Index point_a, Index point_b, double chi2) const {
  const std::array<Index, 4> entries{point_a, point_a + 1, point_b, point_b + 1};
  Eigen::Matrix4d P;
  state_.covariance(entries, entries, P);
  const Eigen::Matrix2d S = P.topLeftCorner<2, 2>() + P.bottomRightCorner<2, 2>() - P.topRightCorner<2, 2>() -
                            P.bottomLeftCorner<2, 2>() + kSamePlace_m2 * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d apart = state_.position(point_a) - state_.position(point_b);
  return apart.dot(S.ldlt().solve(apart)) < chi2;
}

void BearingEkf::merge(Index kept, Index dropped) {
  const Eigen::Vector2d apart = state_.position(kept) - state_.position(dropped);
  rows_.clear();
  for (const Index i : {0, 1}) {
    ObservationRow& row = rows_.emplace_back();
    const double plus = 1.0, minus = -1.0;
    row.add(kept + i, {&plus, 1});
    row.add(dropped + i, {&minus, 1});
    row.innovation = -apart(i);
    row.variance = kSamePlace_m2;
  }
  state_.update(rows_, settings_.retraction);
  state_.remove(dropped, BlockKind::point);
}

void BearingEkf::promote(Index block) {
  Eigen::Matrix<double, 2, 4> jacobian;
  const Eigen::Vector2d point = point_of(ray(block), &jacobian);
  state_.promote(block, point, jacobian);
}

// Second-order terms that the rows leave out.

namespace {

/// Second moment of across times along. Only position and landmark contribute: the azimuth is linear in the heading.
template <int LandmarkSize>
double curvature_rad2(const JointState& state, const MappedSighting& sighting,
                      const PredictedBearing<LandmarkSize>& predicted, const Stretch<LandmarkSize>& stretch) {
  constexpr auto kSize = as_size(LandmarkSize);
  ObservationRow across, along;
  across.add(sighting.pose, {predicted.by_pose.data(), 2});
  across.add(sighting.landmark, {predicted.by_landmark.data(), kSize});
  along.add(sighting.pose, {stretch.by_position.data(), 2});
  along.add(sighting.landmark, {stretch.by_landmark.data(), kSize});
  return variance_of_product(state, across, along);
}

/// Second moment of d(rho) d(anchor - p), the part across m.
double curvature_of_ray_rad2(const JointState& state, const MappedSighting& sighting, const InverseDepth& ray) {
  const Eigen::Vector2d m = ray.inverse_distance_per_m * (ray.anchor - state.position(sighting.pose)) + ray.direction();
  const Eigen::Vector2d across = Eigen::Vector2d(-m.y(), m.x()) / m.squaredNorm(), against = -across;
  ObservationRow shift, inverse_distance;
  shift.add(sighting.landmark, {across.data(), 2});
  shift.add(sighting.pose, {against.data(), 2});
  const double one = 1.0;
  inverse_distance.add(sighting.landmark + 3, {&one, 1});
  return variance_of_product(state, shift, inverse_distance);
}

}  // namespace

double BearingEkf::camera_curvature_rad2(double camera_azimuth_rad, double radius_px) const {
  if (!offsets_.errors_block || std::isnan(radius_px)) return 0.0;
  const auto [mean, covariance] = *camera_errors();
  const auto [p_px, by_camera] = centred(camera_azimuth_rad, radius_px, mean, offsets_.profile);
  return curvature_by_centre_rad2(p_px, by_camera * covariance * by_camera.transpose(), CameraOffsets::kNearCentre_px);
}

double BearingEkf::curvature_rad2(const MappedSighting& sighting) const {
  if (!settings_.charge_curvature) return 0.0;
  const double by_camera = camera_curvature_rad2(sighting.azimuth_rad, sighting.radius_px);
  const Pose2 T_map_body = state_.pose(sighting.pose);
  if (sighting.kind == BlockKind::point) {
    const Eigen::Vector2d p_map_landmark = state_.position(sighting.landmark);
    const auto predicted = predict_bearing(T_map_body, p_map_landmark, settings_.min_distance_m);
    if (!predicted) return by_camera;
    return by_camera + azimuth::curvature_rad2(state_, sighting, *predicted, stretch(T_map_body, p_map_landmark));
  }
  const InverseDepth seen_along = ray(sighting.landmark);
  const auto predicted = predict_bearing(T_map_body, seen_along, settings_.min_distance_m);
  if (!predicted) return by_camera;
  return by_camera + azimuth::curvature_rad2(state_, sighting, *predicted, stretch(T_map_body, seen_along)) +
         curvature_of_ray_rad2(state_, sighting, seen_along);
}

}  // namespace azimuth
