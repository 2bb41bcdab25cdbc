#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "slam/ekf/camera_errors.hpp"
#include "slam/ekf/considered_rig.hpp"
#include "slam/ekf/joint_state.hpp"
#include "slam/ekf/lamp_model.hpp"
#include "slam/ekf/saved_state.hpp"
#include "slam/geometry/motion.hpp"

namespace azimuth {

struct LampEkfModel {
  JointState::Retraction retraction = JointState::Retraction::invariant;
  double camera_height_m = 0.0;  ///< Height of the camera above the map's zero of heights
  double min_height_m = 0.2;     ///< Lamps less than this above the camera are not used
  /// Initial standard deviation of the image's centre along u and along v, as a state; 0: exact.
  double sigma_centre_px = 0.0;
  double sigma_tilt_rad = 0.0;  ///< Initial standard deviation of roll and of pitch, as states; 0: exact
  /// Initial mean of the camera errors, laid out as CameraErrors::mean; the centre is given as (u, v).
  Eigen::Vector4d camera_errors = Eigen::Vector4d::Zero();
  /// Charge directions with the terms that a linear update leaves out (lens_curvature(), offset_curvature()).
  bool charge_curvature = true;
  /// Standard deviations of the rig's considered constants (considered_rig.hpp); 0: exact.
  Considered sigma_considered = Considered::Zero();
};

/// A lamp in the state.
struct LampBlock {
  Index block = 0;
  BlockKind kind = BlockKind::inverse_height;  ///< inverse_height or point3
};

/// A measured direction, corrected for the camera's estimated errors.
struct LampSeen {
  TangentDirection direction;
  /// The derivative of the direction by the camera's errors, in the order of CameraErrors::mean. Its rows tell how far
  /// an error moves the direction across and along (the axes of TangentDirection), in radians per pixel or per radian.
  Eigen::Matrix<double, 2, 4> by_camera = Eigen::Matrix<double, 2, 4>::Zero();

  /// Covariance of (across, along) [rad^2] due to camera errors of this covariance.
  Eigen::Matrix2d covariance_by_camera(const Eigen::Matrix4d& covariance) const {
    return by_camera * covariance * by_camera.transpose();
  }
};

/// A direction measured to a lamp that is in the state.
struct MappedLampSighting {
  LampBlock lamp;
  LampSeen seen;
};

/// Estimated position of a lamp as a Gaussian point.
struct LampPoint {
  Eigen::Vector3d p_map_lamp_m;
  Eigen::Matrix3d covariance_m2;
};

/// The predicted offset per metre of a lamp, in the robot's frame (lamp_model.hpp). The rows hold its Jacobian; their
/// innovations and variances are unused.
struct PredictedLamp {
  Eigen::Vector2d m;
  RowPair rows;
};

/// One joint filter over the pose and lamps in space, without bookkeeping: the caller decides which lamp a direction
/// belongs to, and what counts as a lamp. The covariance is handled as in the planar EKF (JointState).
///
/// Thread contract: thread-bound. predict() and update() do not allocate once the state has stopped growing.
class LampEkf {
 public:
  explicit LampEkf(const LampEkfModel& model);

  const JointState& state() const { return state_; }
  /// Errors of the image's centre (u, v) and of the tilt. Nothing while both are exact.
  std::optional<CameraErrors> camera_errors() const;

  double camera_height_m() const { return model_.camera_height_m; }

  /// Restores pose, camera and lamps from a saved map, in which all lamps have heights; to be called before anything
  /// else. The camera is not restored if the saved filter estimated other camera states. Returns the blocks of the
  /// lamps, which are points.
  std::vector<Index> restore(const MapSnapshot& map);
  /// From now on only the robot and the camera are corrected, and no lamp can be added; see JointState::hold_from().
  void hold_map() { state_.hold_from(kCameraEntry + camera_entries()); }
  /// Number of estimated camera entries, from kCameraEntry on.
  Index camera_entries() const { return errors_size_; }

  /// Moves the robot (mathematics I.3). The motion may consist of many segments and carries their noise.
  void predict(const Motion& motion);
  /// See BearingEkf::believe().
  void believe(const Considered& errors) { state_.believe(errors, model_.retraction); }
  /// Adds noise to the robot's pose without moving it.
  void inflate_robot(const Eigen::Matrix3d& noise) { state_.inflate_robot(noise); }
  /// Replaces the robot's pose by one with an independent covariance, uncorrelated with the map.
  void place_robot(const Pose2& T_map_body, const Eigen::Matrix3d& covariance);

  /// The predicted offset of the lamp. Nothing when the lamp is not above the camera.
  std::optional<PredictedLamp> predict(const LampBlock& lamp) const;
  /// Covariance of the m of two lamps.
  Eigen::Matrix2d covariance(const PredictedLamp& a, const PredictedLamp& b) const;

  /// One batch update with both axes of every direction. Directions that cannot be linearised are left out. Returns
  /// false if nothing was changed.
  bool update(std::span<const MappedLampSighting> sightings);
  /// ln of the probability density [1/sr] of the direction, given that it belongs to the lamp. Minus infinity where it
  /// cannot be computed.
  double log_density(const MappedLampSighting& sighting);
  /// Corrects only the lamp, which may turn out to be clutter: robot, camera and the other lamps are considered.
  bool update_lamp(const MappedLampSighting& sighting);

  /// Adds a lamp from one direction measured at the present pose, with a guess of its height above the camera. The
  /// direction must not be used again.
  LampBlock add_lamp(const LampSeen& seen, double inverse_height_per_m, double sigma_inverse_height_per_m);
  /// Adds a lamp as a linear function of entries of the state, plus noise; see JointState::add().
  LampBlock add_point(const Eigen::Vector3d& p_map_lamp, std::span<const Index> sources,
                      const Eigen::Ref<const Eigen::MatrixXd>& jacobian, const Eigen::Matrix3d& noise);
  void remove(const LampBlock& lamp) { state_.remove(lamp.block, lamp.kind); }

  LampPoint point(const LampBlock& lamp) const;
  /// Additional covariance of the lamp's position due to the rig's considered errors: the scale of the map is
  /// uncertain.
  Eigen::Matrix3d covariance_by_considered(const LampBlock& lamp) const;

  /// The relative standard deviation of the inverse height: the ratio of the second-order to the first-order term of m
  /// as a function of the height. The ratio is small when a Gaussian point describes the lamp as well as the inverse
  /// height does.
  double nonlinearity(const LampBlock& lamp) const;
  /// Converts an inverse height to the point it describes.
  void promote(LampBlock& lamp);

  /// Squared Mahalanobis distance of two points by their joint covariance, 3 degrees of freedom.
  double squared_distance(const LampBlock& point_a, const LampBlock& point_b) const;
  /// Merges two points of the same lamp: the information on both goes into `kept`, `dropped` is removed.
  void merge(const LampBlock& kept, const LampBlock& dropped);

 private:
  static constexpr std::size_t kTypicalRows = 128;
  InverseHeight inverse_height(Index block) const;
  Eigen::Vector3d position(Index block) const;
  void append_rows(const MappedLampSighting& sighting);
  Eigen::Vector2d curvature(const MappedLampSighting& sighting, const PredictedLamp& predicted,
                            const TangentDirection::Residual& residual) const;

  LampEkfModel model_;
  JointState state_;
  Index errors_size_ = 0;  // camera entries from kCameraEntry on: 0, 2 (centre) or 4 (centre, then tilt)
  std::vector<ObservationRow> rows_;
};

// Noise charged for the second-order terms that a linear update of a lamp's direction leaves out; see curvature.hpp for
// the reason.
//
// The lamp. In the plane tangent to the sphere at the measured direction, M = (m, 1) appears at d_k = (axis_k . M) /
// (towards . M). For an error dM of M and its relative change in length s = towards . dM / |M|, the error of d_k is
// d_k - d_k s, of which the linear update models d_k. m itself (lamp_model.hpp) has the second-order terms
//   for a point, with dz the relative error of its height:  -dm dz, so that s grows by dz
//   for an inverse height:                                  dw R^T (da - dp)
//
// The lens. At the image radius r with the zenith angle t, let b = dt/dr, and let a = sin(t) / r be the factor from a
// step across to an angle. An error (x across, y along) [px] of the centre moves the direction by (a x, b y), and in
// second order by
//   across  (b cos t - a) / r x y,    along  (b - a cos t) / (2 r) x^2
// Both vanish in the middle of the image.
//
// The offset g of a new lamp, stored from its first observation: for an error (c, l) of the direction, the error of the
// offset is the linear term times 1 + l tan t.

/// The row of by_offset . m for a predicted lamp.
ObservationRow along(const Eigen::RowVector2d& by_offset, const PredictedLamp& predicted);

/// Variances of (across, along) [rad^2]: lens_curvature() for an uncertain centre, offset_curvature() for all camera
/// errors. `covariance` is laid out as in CameraErrors.
Eigen::Vector2d lens_curvature(const LampSeen& seen, const Eigen::Matrix4d& covariance);
Eigen::Vector2d offset_curvature(const LampSeen& seen, const Eigen::Matrix4d& covariance);

}  // namespace azimuth
