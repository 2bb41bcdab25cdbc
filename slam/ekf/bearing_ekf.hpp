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
  int max_iterations = 1;                   ///< of the update; 1: the plain EKF
  double iterate_below_heading_rad = 0.05;  ///< the heading's standard deviation above which it is not iterated
  double min_distance_m = 0.05;             ///< nearer landmarks are not used (SPEC I.6)
  double yaw_offset_rad = 0.0;              ///< camera's yaw on the robot: robot azimuth = camera azimuth + yaw
  bool estimate_yaw = false;                ///< carry the yaw as a state
  double sigma_yaw_rad = 0.0;               ///< its initial standard deviation
  /// Initial standard deviation of the image's centre along u and along v, as a state; 0: it is exact.
  double sigma_centre_px = 0.0;
  /// Of roll and pitch likewise; takes a camera whose profile is known.
  double sigma_tilt_rad = 0.0;
  std::optional<RadialProfile> profile = {};
  /// Their initial mean, as in CameraErrors; the centre's is (towards azimuth 0, towards azimuth pi/2).
  Eigen::Vector4d camera_errors = Eigen::Vector4d::Zero();
  /// Bearings are charged for what a linear update leaves out (curvature.hpp).
  bool charge_curvature = false;
  /// Standard deviations of what the rig leaves unknown (considered_rig.hpp); 0: exact.
  Considered sigma_considered = Considered::Zero();
};

/// The bearing-only EKF of SPEC part I without bookkeeping: which landmark a bearing belongs to, and when one is
/// initialised, is decided outside.
///
/// Thread contract: thread-bound. predict() and update() do not allocate once the state has stopped growing.
class BearingEkf {
 public:
  static constexpr double kNoRadius = std::numeric_limits<double>::quiet_NaN();

  explicit BearingEkf(const BearingEkfSettings& settings);

  const JointState& state() const { return state_; }
  double yaw_offset_rad() const { return offsets_.yaw_block ? state_.mean(*offsets_.yaw_block) : offsets_.yaw_rad; }
  /// Of the image's centre (towards azimuth 0, towards azimuth pi/2) and of the tilt; nothing while both are exact.
  std::optional<CameraErrors> camera_errors() const;

  /// SPEC I.3, with the noise of a motion carried over many segments.
  void predict(const Motion& motion);

  /// Takes over what another filter knew of pose, camera and points; to be called before anything else. The camera is
  /// left as it is when that filter estimated something else of it. Returns the points' blocks.
  std::vector<Index> restore(const MapSnapshot& map) { return azimuth::restore(map, camera_entries(), state_); }
  /// Forgets what was known of the robot's pose, for another with a covariance that has nothing to do with the map.
  void place_robot(const Pose2& T_map_body, const Eigen::Matrix3d& covariance);
  /// From now on only the robot and the camera are corrected; see JointState::hold_from().
  void hold_map() { state_.hold_from(kCameraEntry + camera_entries()); }
  /// What of the camera is estimated: that many entries from kCameraEntry on.
  Index camera_entries() const { return (offsets_.yaw_block ? 1 : 0) + offsets_.errors_size(); }

  /// Goes by such errors of the rig from now on, whatever its settings say: JointState::believe().
  void believe(const Considered& errors) { state_.believe(errors, retraction()); }

  /// Adds noise to the robot's pose where it stands.
  void inflate_robot(const Eigen::Matrix3d& noise) { state_.inflate_robot(noise); }

  /// Innovation and Jacobian at the present mean (SPEC I.6); nothing when the landmark is too near to be used.
  std::optional<ObservationRow> linearise(const MappedSighting& sighting) const;

  /// What its row leaves out, as a variance [rad^2] to be added to its noise; 0 unless the settings charge it.
  double curvature_rad2(const MappedSighting& sighting) const;

  /// H_a P H_b^T: the covariance of two predicted azimuths.
  double prediction_covariance(const ObservationRow& a, const ObservationRow& b) const {
    return state_.covariance(a, b);
  }

  /// One batch update (SPEC I.7) with each sighting's variance and its curvature, iterated when the settings say so:
  /// the linearisation is moved to the posterior mean until that stands still. Sightings that cannot be linearised are
  /// left out. False: nothing was changed.
  bool update(std::span<const MappedSighting> sightings);

  /// Where the robot must be to see mapped points so, whatever the filter believes; see resect(). All
  /// bearings count as the least certain one; the camera's offsets, where estimated, are taken as known.
  std::optional<Resection> resect(std::span<const MappedSighting> sightings) const;

  /// Believes it: the pose becomes a function of the points and bearings it was found from, correlated with the map as
  /// it should be. The bearings are used up by that.
  void relocate(std::span<const MappedSighting> sightings, const Resection& found);

  /// Stochastic cloning of the robot's pose (SPEC I.4).
  Index clone_robot() { return state_.clone_robot(); }

  /// The two poses' joint covariance, for the quality test.
  Matrix6d joint_pose_covariance(Index pose_i, Index pose_j) const;

  /// A sighting from the pose in `block`, as triangulation wants it (the camera's offsets applied).
  Sighting sighting_from(Index block, double camera_azimuth_rad, double radius_px = kNoRadius) const;

  /// d(azimuth) / d(CameraErrors) of a bearing.
  Eigen::RowVector4d by_camera(double camera_azimuth_rad, double radius_px) const;

  /// Adds the landmark where two sightings meet (SPEC I.8). `by_camera` has a row for each of them, see
  /// by_camera().
  Index add_point(const Intersection& meeting, Index pose_i, Index pose_j, double sigma_bearing_rad,
                  const Eigen::Matrix<double, 2, 4>& by_camera = Eigen::Matrix<double, 2, 4>::Zero());

  /// Adds a landmark from one bearing taken here: its distance is a guess with a spread that includes infinity.
  Index add_ray(double camera_azimuth_rad, double sigma_bearing_rad, double inverse_distance_per_m,
                double sigma_inverse_distance_per_m, double radius_px = kNoRadius);

  InverseDepth ray(Index block) const;

  /// 4 sigma_d |cos parallax| / d (Civera, Davison, Montiel, ICRA 2007): small when a Gaussian point describes the
  /// landmark in `block` as well as the ray does.
  double linearity_index(Index block) const;

  /// Turns the ray in `block` into the point it describes; the block stays where it is.
  void promote(Index block);

  /// Whether two points differ by no more than their joint covariance allows: d^T (P_aa + P_bb - P_ab - P_ba)^-1 d is
  /// below `chi2` (of 2 degrees of freedom).
  bool may_be_one(Index point_a, Index point_b, double chi2) const;

  /// Makes one point of two that are the same: what is known of both goes into `kept`, `dropped` is removed.
  void merge(Index kept, Index dropped);

  void remove(Index block, BlockKind kind) { state_.remove(block, kind); }

 private:
  /// What is held cannot turn with the robot's heading.
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
