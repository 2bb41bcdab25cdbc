#include "slam/ekf/lamp_ekf.hpp"

#include <Eigen/Cholesky>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "slam/ekf/curvature.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

template <int LampSize>
PredictedLamp with_rows(const LampOffset<LampSize>& offset, Index lamp) {
  PredictedLamp predicted{offset.m, {}};
  for (int k = 0; k < 2; ++k) {
    ObservationRow& row = predicted.rows[as_size(k)];
    const Eigen::RowVector3d by_pose = offset.by_pose.row(k);
    const Eigen::Matrix<double, 1, LampSize> by_lamp = offset.by_lamp.row(k);
    row.add(JointState::kPose, {by_pose.data(), 3});
    row.add(lamp, {by_lamp.data(), as_size(LampSize)});
  }
  return predicted;
}

constexpr double kStraightUp = 1e-3;  // sine of the zenith angle below which across and along are undefined

}  // namespace

LampEkf::LampEkf(const LampEkfModel& model) : model_(model) {
  rows_.reserve(kTypicalRows);
  const auto add = [&](const Eigen::Vector2d& mean, double sigma) {
    state_.add(BlockKind::plain_pair, mean, {}, Eigen::MatrixXd(2, 0), sigma * sigma * Eigen::Matrix2d::Identity());
    errors_size_ += size_of(BlockKind::plain_pair);
  };
  const bool leans = model.sigma_tilt_rad > 0.0;
  if (model.sigma_centre_px > 0.0 || leans) add(model.camera_errors.head<2>(), model.sigma_centre_px);
  if (leans) add(model.camera_errors.tail<2>(), model.sigma_tilt_rad);
  state_.consider(model.sigma_considered.cwiseAbs2());
  set_of_placed_robot(state_);
}

std::optional<CameraErrors> LampEkf::camera_errors() const {
  if (errors_size_ == 0) return std::nullopt;
  CameraErrors errors;
  for (Index c = 0; c < errors_size_; ++c) {
    errors.mean(c) = state_.mean(kCameraEntry + c);
    for (Index r = 0; r < errors_size_; ++r)
      errors.covariance(r, c) = state_.covariance(kCameraEntry + r, kCameraEntry + c);
  }
  return errors;
}

void LampEkf::predict(const Motion& motion) { move(motion, state_); }

std::vector<Index> LampEkf::restore(const MapSnapshot& map) {
  const std::vector<Index> blocks = azimuth::restore(map, camera_entries(), state_);
  for (const Index block : blocks)  // heights scale with the map, relative to the camera
    state_.set_by_considered(block + 2, (state_.mean(block + 2) - model_.camera_height_m) *
                                            Considered::Unit(considered::scale_distance).transpose());
  return blocks;
}

void LampEkf::place_robot(const Pose2& T_map_body, const Eigen::Matrix3d& covariance) {
  state_.replace_robot(T_map_body, {}, Eigen::Matrix3Xd(3, 0), covariance);
  set_of_placed_robot(state_);
}

InverseHeight LampEkf::inverse_height(Index block) const {
  return {state_.position(block), state_.position(block + 2), state_.mean(block + 4)};
}

Eigen::Vector3d LampEkf::position(Index block) const {
  return {state_.mean(block), state_.mean(block + 1), state_.mean(block + 2)};
}

std::optional<PredictedLamp> LampEkf::predict(const LampBlock& lamp) const {
  if (lamp.kind == BlockKind::inverse_height)
    return with_rows(predict_offset(state_.pose(), inverse_height(lamp.block)), lamp.block);
  const auto offset = predict_offset(state_.pose(), position(lamp.block), model_.camera_height_m, model_.min_height_m);
  if (!offset) return std::nullopt;
  return with_rows(*offset, lamp.block);
}

Eigen::Matrix2d LampEkf::covariance(const PredictedLamp& a, const PredictedLamp& b) const {
  return state_.covariance(a.rows, b.rows);
}

bool LampEkf::update(std::span<const MappedLampSighting> sightings) {
  rows_.clear();
  for (const MappedLampSighting& sighting : sightings) append_rows(sighting);
  return state_.update(rows_, model_.retraction);
}

double LampEkf::log_density(const MappedLampSighting& sighting) {
  constexpr double kNever = -std::numeric_limits<double>::infinity();
  rows_.clear();
  append_rows(sighting);
  if (rows_.empty()) return kNever;
  const ObservationRow &x = rows_[0], &y = rows_[1];
  const double xy = state_.covariance(x, y);
  const double xx = state_.covariance(x, x) + x.variance, yy = state_.covariance(y, y) + y.variance;
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 0.0)) return kNever;
  const double squared =
      (yy * x.innovation * x.innovation - 2.0 * xy * x.innovation * y.innovation + xx * y.innovation * y.innovation) /
      determinant;
  return -0.5 * (squared + std::log(4.0 * kPi * kPi * determinant));
}

bool LampEkf::update_lamp(const MappedLampSighting& sighting) {
  rows_.clear();
  append_rows(sighting);
  return state_.update_only(sighting.lamp.block, sighting.lamp.kind, rows_);
}

/// Appends both axes of the direction, if it can be linearised.
void LampEkf::append_rows(const MappedLampSighting& sighting) {
  const std::optional<PredictedLamp> predicted = predict(sighting.lamp);
  if (!predicted) return;
  const auto residual = sighting.seen.direction.against(predicted->m);
  if (!residual) return;
  const Eigen::Vector2d variance = sighting.seen.direction.variance() + curvature(sighting, *predicted, *residual);
  for (Index axis = 0; axis < 2; ++axis) {
    ObservationRow& row = rows_.emplace_back(along(residual->by_offset.row(axis), *predicted));
    row.innovation = residual->innovation(axis);
    row.variance = variance(axis);
    const Eigen::RowVector4d by_camera = -sighting.seen.by_camera.row(axis);
    if (errors_size_ > 0) row.add(kCameraEntry, {by_camera.data(), as_size(errors_size_)});
  }
}

/// (a, g, w) = (p, R(heading) g_body, w0), with the derivative by the pose G = [I, 0; 0, (-g_y, g_x); 0, 0].
LampBlock LampEkf::add_lamp(const LampSeen& seen, double inverse_height_per_m, double sigma_inverse_height_per_m) {
  const Pose2 T_map_body = state_.pose();
  const Eigen::Matrix2d R_map_body = to_body(T_map_body.heading_rad).transpose();
  const Eigen::Vector2d g = R_map_body * seen.direction.offset_per_metre();
  Eigen::Matrix<double, 5, 1> mean;
  mean << T_map_body.position(), g, inverse_height_per_m;
  const Eigen::Matrix2d by_error = R_map_body * seen.direction.offset_by_error();
  Eigen::Matrix<double, 5, 7> by_sources = Eigen::Matrix<double, 5, 7>::Zero();  // the pose, then the camera
  by_sources.topLeftCorner<2, 2>().setIdentity();
  by_sources.block<2, 1>(2, 2) = -turned_back(g);
  by_sources.block<2, 4>(2, 3) = by_error * seen.by_camera;
  Eigen::Matrix<double, 5, 5> noise = Eigen::Matrix<double, 5, 5>::Zero();
  Eigen::Vector2d variance = seen.direction.variance();
  if (const auto errors = camera_errors(); errors && model_.charge_curvature)
    variance += lens_curvature(seen, errors->covariance) + offset_curvature(seen, errors->covariance);
  noise.block<2, 2>(2, 2) = by_error * variance.asDiagonal() * by_error.transpose();
  noise(4, 4) = sigma_inverse_height_per_m * sigma_inverse_height_per_m;
  static_assert(kCameraEntry == JointState::kPose + 3);
  std::array<Index, 7> sources{};
  std::iota(sources.begin(), sources.end(), JointState::kPose);
  const Index used = kCameraEntry + errors_size_;
  return {state_.add(BlockKind::inverse_height, mean, std::span(sources).first(as_size(used)),
                     by_sources.leftCols(used), noise),
          BlockKind::inverse_height};
}

LampBlock LampEkf::add_point(const Eigen::Vector3d& p_map_lamp, std::span<const Index> sources,
                             const Eigen::Ref<const Eigen::MatrixXd>& jacobian, const Eigen::Matrix3d& noise) {
  return {state_.add(BlockKind::point3, p_map_lamp, sources, jacobian, noise), BlockKind::point3};
}

LampPoint LampEkf::point(const LampBlock& lamp) const {
  if (lamp.kind == BlockKind::point3) return {position(lamp.block), state_.block_covariance<3>(lamp.block, lamp.block)};
  Eigen::Matrix<double, 3, 5> jacobian;
  LampPoint point;
  point.p_map_lamp_m = point_of(inverse_height(lamp.block), model_.camera_height_m, &jacobian);
  point.covariance_m2 = jacobian * state_.block_covariance<5>(lamp.block, lamp.block) * jacobian.transpose();
  return point;
}

Eigen::Matrix3d LampEkf::covariance_by_considered(const LampBlock& lamp) const {
  if (lamp.kind == BlockKind::point3) return azimuth::covariance_by_considered<3>(state_, lamp.block);
  Eigen::Matrix<double, 3, 5> jacobian;
  point_of(inverse_height(lamp.block), model_.camera_height_m, &jacobian);
  return azimuth::covariance_by_considered(state_, lamp.block, jacobian);
}

double LampEkf::nonlinearity(const LampBlock& lamp) const {
  assert(lamp.kind == BlockKind::inverse_height);
  const double w = state_.mean(lamp.block + 4);
  if (!(w > 0.0)) return std::numeric_limits<double>::infinity();
  return std::sqrt(state_.covariance(lamp.block + 4, lamp.block + 4)) / w;
}

void LampEkf::promote(LampBlock& lamp) {
  Eigen::Matrix<double, 3, 5> jacobian;
  const Eigen::Vector3d point = point_of(inverse_height(lamp.block), model_.camera_height_m, &jacobian);
  state_.promote(lamp.block, point, jacobian);
  lamp.kind = BlockKind::point3;
}

double LampEkf::squared_distance(const LampBlock& point_a, const LampBlock& point_b) const {
  const Index a = point_a.block, b = point_b.block;
  const Eigen::Matrix3d across = state_.block_covariance<3>(a, b);
  const Eigen::Matrix3d S = state_.block_covariance<3>(a, a) + state_.block_covariance<3>(b, b) - across -
                            across.transpose() + kSamePlace_m2 * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d apart = position(a) - position(b);
  return apart.dot(S.ldlt().solve(apart));
}

void LampEkf::merge(const LampBlock& kept, const LampBlock& dropped) {
  rows_.clear();
  for (Index i = 0; i < 3; ++i) {
    ObservationRow& row = rows_.emplace_back();
    const double plus = 1.0, minus = -1.0;
    row.add(kept.block + i, {&plus, 1});
    row.add(dropped.block + i, {&minus, 1});
    row.innovation = state_.mean(dropped.block + i) - state_.mean(kept.block + i);
    row.variance = kSamePlace_m2;
  }
  state_.update(rows_, model_.retraction);
  remove(dropped);
}

ObservationRow along(const Eigen::RowVector2d& by_offset, const PredictedLamp& predicted) {
  const auto& [x, y] = predicted.rows;
  ObservationRow row = x;
  for (std::size_t p = 0; p < as_size(x.count); ++p)
    for (std::size_t i = 0; i < x.parts[p].coefficients.size(); ++i)
      row.parts[p].coefficients[i] =
          by_offset(0) * x.parts[p].coefficients[i] + by_offset(1) * y.parts[p].coefficients[i];
  return row;
}

Eigen::Vector2d lens_curvature(const LampSeen& seen, const Eigen::Matrix4d& covariance) {
  const Eigen::Matrix2d by_centre = seen.by_camera.leftCols<2>(), P = covariance.topLeftCorner<2, 2>();
  const double a = by_centre.row(0).norm(), b = by_centre.row(1).norm();
  const double sine = seen.direction.zenith_sine(), cosine = seen.direction.zenith_cosine();
  if (!(a > 0.0) || !(b > 0.0) || sine < kStraightUp) return Eigen::Vector2d::Zero();
  const double by_radius = a / sine;
  const Eigen::RowVector2d x = by_centre.row(0) / a, y = by_centre.row(1) / b;
  const double xx = x * P * x.transpose(), yy = y * P * y.transpose(), xy = x * P * y.transpose();
  const double across = (b * cosine - a) * by_radius, along = 0.5 * (b - a * cosine) * by_radius;
  return {across * across * variance_of_product(xx, yy, xy), along * along * variance_of_product(xx, xx, xx)};
}

Eigen::Vector2d offset_curvature(const LampSeen& seen, const Eigen::Matrix4d& covariance) {
  const Eigen::Matrix2d P = seen.covariance_by_camera(covariance);
  const double tangent = seen.direction.zenith_sine() / seen.direction.zenith_cosine();
  return tangent * tangent *
         Eigen::Vector2d(variance_of_product(P(0, 0), P(1, 1), P(0, 1)),
                         variance_of_product(P(1, 1), P(1, 1), P(1, 1)));
}

Eigen::Vector2d LampEkf::curvature(const MappedLampSighting& sighting, const PredictedLamp& predicted,
                                   const TangentDirection::Residual& residual) const {
  if (!model_.charge_curvature) return Eigen::Vector2d::Zero();
  const Index lamp = sighting.lamp.block;
  ObservationRow stretch = along(residual.stretch, predicted);
  if (sighting.lamp.kind == BlockKind::point3)
    stretch.parts[1].coefficients[2] += 1.0 / (state_.mean(lamp + 2) - model_.camera_height_m);
  ObservationRow inverse_height;
  const double one = 1.0;
  inverse_height.add(lamp + 4, {&one, 1});
  Eigen::Vector2d variance = Eigen::Vector2d::Zero();
  for (Index axis = 0; axis < 2; ++axis) {
    const Eigen::RowVector2d by_offset = residual.by_offset.row(axis);
    variance(axis) = variance_of_product(state_, along(by_offset, predicted), stretch);
    if (sighting.lamp.kind != BlockKind::inverse_height) continue;
    const Eigen::RowVector2d by_anchor = by_offset * to_body(state_.pose().heading_rad), by_robot = -by_anchor;
    ObservationRow shift;
    shift.add(lamp, {by_anchor.data(), 2});
    shift.add(JointState::kPose, {by_robot.data(), 2});
    variance(axis) += variance_of_product(state_, shift, inverse_height);
  }
  if (const auto errors = camera_errors()) variance += lens_curvature(sighting.seen, errors->covariance);
  return variance;
}

}  // namespace azimuth
