#pragma once
#include <Eigen/Core>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "slam/ekf/camera_errors.hpp"
#include "slam/ekf/camera_offsets.hpp"
#include "slam/ekf/considered_rig.hpp"
#include "slam/ekf/joint_state.hpp"
#include "slam/ekf/relinearisation.hpp"
#include "slam/ekf/resection.hpp"
#include "slam/ekf/saved_state.hpp"
#include "slam/ekf/triangulation.hpp"
#include "slam/geometry/motion.hpp"

namespace azimuth {

struct BearingEkfSettings {
  JointState::Retraction retraction = JointState::Retraction::invariant;
  int max_iterations = 1;                   ///< Iterations of the update; 1: the plain EKF
  double iterate_below_heading_rad = 0.05;  ///< No iteration while the heading's standard deviation is larger
  double min_distance_m = 0.05;             ///< Bearings of nearer landmarks are not used (mathematics I.6)
  double yaw_offset_rad = 0.0;              ///< Camera's yaw on the robot: robot azimuth = camera azimuth + yaw
  bool estimate_yaw = false;                ///< Estimate the yaw as a state
  double sigma_yaw_rad = 0.0;               ///< Initial standard deviation of the yaw
  /// Initial standard deviation of the image's centre along u and along v, as a state; 0: exact.
  double sigma_centre_px = 0.0;
  /// Initial standard deviation of roll and of pitch, as states; 0: exact. Requires `profile`.
  double sigma_tilt_rad = 0.0;
  std::optional<RadialProfile> profile = {};
  /// Initial mean of the camera errors, laid out as CameraErrors::mean; the centre is given as (towards azimuth 0,
  /// towards azimuth pi/2).
  Eigen::Vector4d camera_errors = Eigen::Vector4d::Zero();
  /// Charge bearings with the terms that a linear update leaves out (curvature.hpp).
  bool charge_curvature = false;
  /// Standard deviations of the rig's considered constants (considered_rig.hpp); 0: exact.
  Considered sigma_considered = Considered::Zero();
};

/// The bearing-only EKF of mathematics part I without bookkeeping: the caller decides which landmark a bearing belongs
/// to and when a landmark is initialised.
///
/// Thread contract: thread-bound. predict() and update() do not allocate once the state has stopped growing.
class BearingEkf {
 public:
  static constexpr double kNoRadius = std::numeric_limits<double>::quiet_NaN();

  explicit BearingEkf(const BearingEkfSettings& settings);

  const JointState& state() const { return state_; }
  double yaw_offset_rad() const { return offsets_.yaw_block ? state_.mean(*offsets_.yaw_block) : offsets_.yaw_rad; }
  /// Errors of the image's centre (towards azimuth 0, towards azimuth pi/2) and of the tilt. Nothing while both are
  /// exact.
  std::optional<CameraErrors> camera_errors() const;

  /// Moves the robot (mathematics I.3). The motion may consist of many segments and carries their noise.
  void predict(const Motion& motion);

  /// Restores pose, camera and points from a saved map; to be called before anything else. The camera is not restored
  /// if the saved filter estimated other camera states. Returns the points' blocks.
  std::vector<Index> restore(const MapSnapshot& map) { return azimuth::restore(map, camera_entries(), state_); }
  /// Replaces the robot's pose by one with an independent covariance, uncorrelated with the map.
  void place_robot(const Pose2& T_map_body, const Eigen::Matrix3d& covariance);
  /// From now on only the robot and the camera are corrected; see JointState::hold_from().
  void hold_map() { state_.hold_from(kCameraEntry + camera_entries()); }
  /// Number of estimated camera entries, from kCameraEntry on.
  Index camera_entries() const { return (offsets_.yaw_block ? 1 : 0) + offsets_.errors_size(); }

  /// Takes these errors of the rig into account from now on; see JointState::believe().
  void believe(const Considered& errors) { state_.believe(errors, retraction()); }

  /// Adds noise to the robot's pose without moving it.
  void inflate_robot(const Eigen::Matrix3d& noise) { state_.inflate_robot(noise); }

  /// Innovation and Jacobian at the present mean (mathematics I.6). Nothing when the landmark is too near to be used.
  std::optional<ObservationRow> linearise(const MappedSighting& sighting) const;

  /// Variance [rad^2] of the terms that the linear row leaves out, to be added to its noise; 0 unless the settings
  /// charge it.
  double curvature_rad2(const MappedSighting& sighting) const;

  /// H_a P H_b^T: the covariance of two predicted azimuths.
  double prediction_covariance(const ObservationRow& a, const ObservationRow& b) const {
    return state_.covariance(a, b);
  }

  /// One batch update (mathematics I.7), each bearing's noise increased by its curvature. It is iterated if the
  /// settings say so: the linearisation point moves to the posterior mean until convergence. Bearings that cannot be
  /// linearised are left out. Returns false if nothing was changed.
  bool update(std::span<const MappedSighting> sightings);

  /// The pose from which mapped points are seen under these bearings, whatever the filter believes; see resect(). All
  /// bearings get the largest of the bearings' standard deviations. The camera's offsets, where estimated, count as
  /// exact.
  std::optional<Resection> resect(std::span<const MappedSighting> sightings) const;

  /// Sets the pose to the one found by resect(): a function of these points and bearings, correlated with the map
  /// accordingly. These bearings must not be used again.
  void relocate(std::span<const MappedSighting> sightings, const Resection& found);

  /// Stochastic cloning of the robot's pose (mathematics I.4).
  Index clone_robot() { return state_.clone_robot(); }

  /// The joint covariance of two poses, for the quality test.
  Matrix6d joint_pose_covariance(Index pose_i, Index pose_j) const;

  /// The bearing, taken from the pose in `block`, in the form that triangulation uses (camera offsets applied).
  Sighting sighting_from(Index block, double camera_azimuth_rad, double radius_px = kNoRadius) const;

  /// d(azimuth) / d(CameraErrors) of a bearing.
  Eigen::RowVector4d by_camera(double camera_azimuth_rad, double radius_px) const;

  /// Adds the landmark at the intersection of two bearings (mathematics I.8). `by_camera` has a row for each bearing,
  /// see by_camera().
  Index add_point(const Intersection& meeting, Index pose_i, Index pose_j, double sigma_bearing_rad,
                  const Eigen::Matrix<double, 2, 4>& by_camera = Eigen::Matrix<double, 2, 4>::Zero());

  /// Adds a landmark from one bearing taken from the present pose. Its distance is a guess whose spread includes
  /// infinity.
  Index add_ray(double camera_azimuth_rad, double sigma_bearing_rad, double inverse_distance_per_m,
                double sigma_inverse_distance_per_m, double radius_px = kNoRadius);

  InverseDepth ray(Index block) const;

  /// 4 sigma_d |cos parallax| / d (Civera, Davison, Montiel, ICRA 2007). The index is small when a Gaussian point
  /// describes the landmark in `block` as well as the ray does.
  double linearity_index(Index block) const;

  /// Converts the ray in `block` to the point it describes; the block keeps its offset.
  void promote(Index block);

  /// Whether the distance d of two points is within their joint covariance: d^T (P_aa + P_bb - P_ab - P_ba)^-1 d is
  /// below `chi2` (2 degrees of freedom).
  bool may_be_one(Index point_a, Index point_b, double chi2) const;

  /// Merges two points of the same landmark: the information on both goes into `kept`, `dropped` is removed.
  void merge(Index kept, Index dropped);

  void remove(Index block, BlockKind kind) { state_.remove(block, kind); }

 private:
  /// Held entries cannot turn with the robot's heading.
  JointState::Retraction retraction() const {
    return state_.holds() ? JointState::Retraction::additive : settings_.retraction;
  }

  double camera_curvature_rad2(double camera_azimuth_rad, double radius_px) const;

  BearingEkfSettings settings_;
  JointState state_;
  CameraOffsets offsets_;
  Relinearisation relinearisation_;
  std::vector<MappedSighting> usable_;
  std::vector<ObservationRow> rows_;
};

}  // namespace azimuth
