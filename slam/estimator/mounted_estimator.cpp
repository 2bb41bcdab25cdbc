#include "slam/estimator/mounted_estimator.hpp"

#include <utility>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

Eigen::Matrix3d pose_block(const PackedSymmetric& P) {
  Eigen::Matrix3d block;
  block << P(0, 0), P(0, 1), P(0, 2), P(1, 0), P(1, 1), P(1, 2), P(2, 0), P(2, 1), P(2, 2);
  return block;
}

}  // namespace

Pose2 point_pose(const Eigen::Vector2d& p_body_m, const Pose2& T_map_body) {
  const Eigen::Vector2d p = T_map_body * p_body_m;
  return {p.x(), p.y(), T_map_body.heading_rad};
}

Eigen::Matrix3d point_pose_by_body(const Eigen::Vector2d& p_body_m, double heading_rad) {
  const Eigen::Vector2d turned = Pose2{0.0, 0.0, heading_rad} * p_body_m;
  Eigen::Matrix3d by_body = Eigen::Matrix3d::Identity();
  by_body(0, 2) = -turned.y();
  by_body(1, 2) = turned.x();
  return by_body;
}

Motion point_motion(const Eigen::Vector2d& p_body_m, const Motion& motion) {
  Motion result = motion;
  result.T_start_end = point_pose(p_body_m, motion.T_start_end);
  result.T_start_end.x_m -= p_body_m.x();
  result.T_start_end.y_m -= p_body_m.y();
  const Eigen::Matrix3d by_body = point_pose_by_body(p_body_m, motion.T_start_end.heading_rad);
  result.covariance = by_body * motion.covariance * by_body.transpose();
  result.by_scales = by_body * motion.by_scales;
  result.by_lag = by_body * motion.by_lag;
  result.by_drift = by_body * motion.by_drift;
  result.velocity_at_end = point_pose_by_body(p_body_m, 0.0) * motion.velocity_at_end;
  return result;
}

void move_pose_to(const Eigen::Vector2d& p_body_m, MapSnapshot& map) {
  const Eigen::Matrix3d by_body = point_pose_by_body(p_body_m, map.T_map_body.heading_rad);
  map.T_map_body = point_pose(p_body_m, map.T_map_body);
  PackedSymmetric& P = map.covariance;
  const Eigen::Matrix3d of_pose = by_body * pose_block(P) * by_body.transpose();
  for (std::size_t row = MapSnapshot::kPoseEntries; row < P.size(); ++row) {
    const Eigen::Vector3d with_pose = by_body * Eigen::Vector3d(P(row, 0), P(row, 1), P(row, 2));
    for (std::size_t i = 0; i < MapSnapshot::kPoseEntries; ++i) P(row, i) = with_pose[as_index(i)];
  }
  for (std::size_t row = 0; row < MapSnapshot::kPoseEntries; ++row)
    for (std::size_t i = 0; i <= row; ++i) P(row, i) = of_pose(as_index(row), as_index(i));
}

MountedEstimator::MountedEstimator(std::unique_ptr<Estimator> of_viewpoint, const Eigen::Vector2d& p_body_viewpoint_m,
                                   bool from_map)
    : of_viewpoint_(std::move(of_viewpoint)),
      p_body_viewpoint_m_(p_body_viewpoint_m),
      p_map_origin_m_(from_map ? Eigen::Vector2d::Zero() : p_body_viewpoint_m) {}

Pose2 MountedEstimator::of_body(const Pose2& T_map_viewpoint) const {
  Pose2 T = point_pose(-p_body_viewpoint_m_, T_map_viewpoint);
  T.x_m += p_map_origin_m_.x();
  T.y_m += p_map_origin_m_.y();
  return T;
}

void MountedEstimator::predict(const Motion& motion) {
  of_viewpoint_->predict(point_motion(p_body_viewpoint_m_, motion));
}

void MountedEstimator::estimate(Estimate& out) const {
  of_viewpoint_->estimate(out);
  const Eigen::Matrix3d by_viewpoint = point_pose_by_body(-p_body_viewpoint_m_, out.T_map_body.heading_rad);
  out.pose_covariance = by_viewpoint * out.pose_covariance * by_viewpoint.transpose();
  out.T_map_body = of_body(out.T_map_body);
  for (LandmarkEstimate& landmark : out.landmarks) landmark.p_map_landmark_m += p_map_origin_m_;
}

void MountedEstimator::look_ahead(const Motion& motion, Estimate& out) const {
  of_viewpoint_->look_ahead(point_motion(p_body_viewpoint_m_, motion), out);
  const Eigen::Matrix3d by_viewpoint = point_pose_by_body(-p_body_viewpoint_m_, out.T_map_body.heading_rad);
  out.pose_covariance = by_viewpoint * out.pose_covariance * by_viewpoint.transpose();
  out.T_map_body = of_body(out.T_map_body);
}

bool MountedEstimator::save_map(MapSnapshot& out) const {
  if (!of_viewpoint_->save_map(out)) return false;
  move_pose_to(-p_body_viewpoint_m_, out);
  out.T_map_body.x_m += p_map_origin_m_.x();
  out.T_map_body.y_m += p_map_origin_m_.y();
  for (MapLandmark& landmark : out.landmarks) landmark.p_map_landmark_m += p_map_origin_m_;
  for (MapView& view : out.views) view.p_map_robot_m += p_map_origin_m_;
  return true;
}

bool MountedEstimator::write_past(std::vector<PastPose>& out) const {
  if (!of_viewpoint_->write_past(out)) return false;
  for (PastPose& past : out) {
    const Eigen::Matrix3d by_viewpoint = point_pose_by_body(-p_body_viewpoint_m_, past.T_map_body.heading_rad);
    past.covariance = by_viewpoint * past.covariance * by_viewpoint.transpose();
    past.T_map_body = of_body(past.T_map_body);
  }
  return true;
}

bool MountedEstimator::write_path(std::vector<PathPose>& out) const {
  if (!of_viewpoint_->write_path(out)) return false;
  for (PathPose& pose : out) pose.T_map_body = of_body(pose.T_map_body);
  return true;
}

std::unique_ptr<Estimator> mounted(const CameraRig& camera, const MapSnapshot* map, const MakeEstimator& make) {
  const Eigen::Vector2d p_m(camera.position_m[0], camera.position_m[1]);
  if (p_m.isZero(0.0)) return make(map);
  std::optional<MapSnapshot> of_viewpoint;
  if (map) move_pose_to(p_m, of_viewpoint.emplace(*map));
  return std::make_unique<MountedEstimator>(make(of_viewpoint ? &*of_viewpoint : nullptr), p_m, map != nullptr);
}

}  // namespace azimuth
