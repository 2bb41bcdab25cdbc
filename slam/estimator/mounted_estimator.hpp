#pragma once
#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "slam/camera/camera_rig.hpp"
#include "slam/estimator/estimator.hpp"

namespace azimuth {

/// Estimators take bearings to be seen from the point whose pose they estimate. Where the camera does not stand over
/// the point that odometry is of, that point is the camera's viewpoint, with the robot's heading: an odometer there
/// would count what `T_viewpoint_body * motion * T_body_viewpoint` says, noise and all. This makes of such an estimator
/// one of the robot: motions go in as the viewpoint's, poses come out as the body's. The map begins where the body does
/// (docs/mathematics.md, VI.32; the papers have no such camera).
///
/// Thread contract: as Estimator.
class MountedEstimator final : public Estimator {
 public:
  /// `of_viewpoint` starts from a map, or not: then its first pose is the origin of its own frame, and here the body's
  /// is.
  MountedEstimator(std::unique_ptr<Estimator> of_viewpoint, const Eigen::Vector2d& p_body_viewpoint_m, bool from_map);

  bool odometry_begins(bool goes_on) override { return of_viewpoint_->odometry_begins(goes_on); }
  void predict(const Motion& motion) override;
  void update(const BearingSet& observations) override { of_viewpoint_->update(observations); }
  void estimate(Estimate& out) const override;
  void look_ahead(const Motion& motion, Estimate& out) const override;
  void expect(std::vector<ExpectedBearing>& out) const override { of_viewpoint_->expect(out); }
  std::optional<CameraErrors> camera_errors() const override { return of_viewpoint_->camera_errors(); }
  RigFinding rig_finding() const override { return of_viewpoint_->rig_finding(); }
  bool save_map(MapSnapshot& out) const override;
  bool write_past(std::vector<PastPose>& out) const override;
  bool write_path(std::vector<PathPose>& out) const override;
  void conclude() override { of_viewpoint_->conclude(); }

 private:
  Pose2 of_body(const Pose2& T_map_viewpoint) const;

  std::unique_ptr<Estimator> of_viewpoint_;
  Eigen::Vector2d p_body_viewpoint_m_;
  Eigen::Vector2d p_map_origin_m_;  ///< of the frame of the estimator of the viewpoint
};

/// What a point at `p_body_m`, that does not turn against the body, does while the body makes `motion`.
Motion point_motion(const Eigen::Vector2d& p_body_m, const Motion& motion);

/// The pose of a point at `p_body_m`, with the body's heading, and d(that) / d(pose of the body).
Pose2 point_pose(const Eigen::Vector2d& p_body_m, const Pose2& T_map_body);
Eigen::Matrix3d point_pose_by_body(const Eigen::Vector2d& p_body_m, double heading_rad);

/// In place of the robot's pose that of such a point, in a map and its covariance.
void move_pose_to(const Eigen::Vector2d& p_body_m, MapSnapshot& map);

/// What `make` makes for a robot whose camera is over the point that odometry is of, for one with this camera. `map` is
/// what it starts from, or null, and lives for the call.
using MakeEstimator = std::function<std::unique_ptr<Estimator>(const MapSnapshot* map)>;
std::unique_ptr<Estimator> mounted(const CameraRig& camera, const MapSnapshot* map, const MakeEstimator& make);

}  // namespace azimuth
