#pragma once
#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "slam/camera/camera_rig.hpp"
#include "slam/estimator/estimator.hpp"

namespace azimuth {

/// Adapts an estimator to a camera that is not mounted over the point that odometry refers to.
///
/// Estimators take bearings to be seen from the point whose pose they estimate. Here that point is the camera's
/// viewpoint, with the robot's heading. An odometer at the viewpoint would measure `T_viewpoint_body * motion *
/// T_body_viewpoint`, noise included. The adapter converts motions to those of the viewpoint on the way in, and poses
/// to those of the body on the way out. The map's origin is the first pose of the body (docs/mathematics.md, VI.32; the
/// papers have no such camera).
///
/// Thread contract: as Estimator.
class MountedEstimator final : public Estimator {
 public:
  /// `from_map`: `of_viewpoint` starts from a saved map. Otherwise the viewpoint's first pose is the origin of its own
  /// frame, while the body's first pose is the origin of the published frame.
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
  Eigen::Vector2d p_map_origin_m_;  ///< Origin of the viewpoint estimator's map frame, in the published map frame
};

/// The motion of a point at `p_body_m`, with the body's heading, while the body makes `motion`.
Motion point_motion(const Eigen::Vector2d& p_body_m, const Motion& motion);

/// The pose of a point at `p_body_m`, with the body's heading, and the derivative of that pose by the body's pose.
Pose2 point_pose(const Eigen::Vector2d& p_body_m, const Pose2& T_map_body);
Eigen::Matrix3d point_pose_by_body(const Eigen::Vector2d& p_body_m, double heading_rad);

/// Replaces the robot's pose in a map and in its covariance by the pose of a point at `p_body_m`, with the body's
/// heading.
void move_pose_to(const Eigen::Vector2d& p_body_m, MapSnapshot& map);

/// An estimator for this camera. `make` makes an estimator for a camera over the point that odometry refers to. `map`
/// is the saved map that the estimator starts from, or null; it is used during the call only.
using MakeEstimator = std::function<std::unique_ptr<Estimator>(const MapSnapshot* map)>;
std::unique_ptr<Estimator> mounted(const CameraRig& camera, const MapSnapshot* map, const MakeEstimator& make);

}  // namespace azimuth
