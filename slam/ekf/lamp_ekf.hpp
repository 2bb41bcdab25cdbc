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
  double camera_height_m = 0.0;  ///< above the map's zero of heights
  double min_height_m = 0.2;     ///< above the camera; lamps found lower are not used
  /// Initial standard deviation of the image's centre along u and along v, as a state; 0: it is exact.
  double sigma_centre_px = 0.0;
  double sigma_tilt_rad = 0.0;  ///< of roll and of pitch, likewise
  /// Their initial mean, as in CameraErrors; the centre's is (u, v).
  Eigen::Vector4d camera_errors = Eigen::Vector4d::Zero();
  /// Directions are charged for what a linear update leaves out (lamp_curvature.hpp).
  bool charge_curvature = true;
  /// As in BearingEkfSettings.
  Considered sigma_considered = Considered::Zero();
};

/// A lamp in the state.
struct LampBlock {
  Index block = 0;
  BlockKind kind = BlockKind::inverse_height;  ///< or point3
};

/// A direction as it was seen, the camera's errors as estimated taken out.
struct LampSeen {
  TangentDirection direction;
  /// d(direction's place across, along) [rad] / d(CameraErrors).
  Eigen::Matrix<double, 2, 4> by_camera = Eigen::Matrix<double, 2, 4>::Zero();

  /// Variances of (across, along) [rad^2] by camera errors of that covariance.
  Eigen::Matrix2d covariance_by_camera(const Eigen::Matrix4d& covariance) const {
    return by_camera * covariance * by_camera.transpose();
  }
};

/// A sighting of a lamp that is in the state.
struct MappedLampSighting {
  LampBlock lamp;
  LampSeen seen;
};

/// Where a lamp is in the map, as far as a point can say it.
struct LampPoint {
  Eigen::Vector3d p_map_lamp_m;
  Eigen::Matrix3d covariance_m2;
};

/// The offset per metre under which a lamp is predicted, in the robot's frame (lamp_model.hpp). The rows hold its
/// Jacobian; their innovations and variances mean nothing.
struct PredictedLamp {
  Eigen::Vector2d m;
  RowPair rows;
};

/// One joint filter over the pose and lamps in space, without bookkeeping: which lamp a sighting is of, and what is a
/// lamp, is decided outside. The covariance is that of the flat EKF (JointState).
///
/// Thread contract: thread-bound. predict() and update() do not allocate once the state has stopped growing.
class LampEkf {
 public:
  explicit LampEkf(const LampEkfModel& model);

  const JointState& state() const { return state_; }
  /// Of the image's centre (u, v) and of the tilt; nothing while both are exact.
  std::optional<CameraErrors> camera_errors() const;

  double camera_height_m() const { return model_.camera_height_m; }

  /// Takes over what another filter knew of pose, camera and lamps, all of which have heights; to be called before
  /// anything else. The camera is left as it is when that filter estimated something else of it. Returns the blocks of
  /// the lamps, which are points.
  std::vector<Index> restore(const MapSnapshot& map);
  /// From now on only the robot and the camera are corrected, and no lamp can be added; see JointState::hold_from().
  void hold_map() { state_.hold_from(kCameraEntry + camera_entries()); }
  /// What of the camera is estimated: that many entries from kCameraEntry on.
  Index camera_entries() const { return errors_size_; }

  /// SPEC I.3, with the noise of a motion carried over many segments.
  void predict(const Motion& motion);
  /// As BearingEkf has it.
  void believe(const Considered& errors) { state_.believe(errors, model_.retraction); }
  /// Adds noise to the robot's pose where it stands.
  void inflate_robot(const Eigen::Matrix3d& noise) { state_.inflate_robot(noise); }
  /// Puts the robot elsewhere, whatever was known of its pose.
  void place_robot(const Pose2& T_map_body, const Eigen::Matrix3d& covariance);

  /// Nothing when the lamp is not above the camera.
  std::optional<PredictedLamp> predict(const LampBlock& lamp) const;
  /// Of the m of two lamps.
  Eigen::Matrix2d covariance(const PredictedLamp& a, const PredictedLamp& b) const;

  /// One batch update with both axes of every sighting. Those that cannot be linearised are left out. False: nothing
  /// was changed.
  bool update(std::span<const MappedLampSighting> sightings);
  /// ln of how likely the direction [1/sr] is of the lamp, by all that is known; minus infinity where that cannot be
  /// told.
  double log_density(const MappedLampSighting& sighting);
  /// Corrects nothing but the lamp, which may turn out to be none: robot, camera and the other lamps are considered.
  bool update_lamp(const MappedLampSighting& sighting);

  /// Adds a lamp from one sighting taken here, at a guess of its height above the camera. The sighting is used up.
  LampBlock add_lamp(const LampSeen& seen, double inverse_height_per_m, double sigma_inverse_height_per_m);
  /// Adds a lamp from what is known of it: a linear function of entries of the state, plus noise, as JointState::add().
  LampBlock add_point(const Eigen::Vector3d& p_map_lamp, std::span<const Index> sources,
                      const Eigen::Ref<const Eigen::MatrixXd>& jacobian, const Eigen::Matrix3d& noise);
  void remove(const LampBlock& lamp) { state_.remove(lamp.block, lamp.kind); }

  LampPoint point(const LampBlock& lamp) const;
  /// What the rig leaves unknown makes uncertain of it besides: it stands in a map that may be too large.
  Eigen::Matrix3d covariance_by_considered(const LampBlock& lamp) const;

  /// The standard deviation of the inverse height as a share of it: the second-order term of m as a function of the
  /// height, over the first. Small when a Gaussian point describes the lamp as well as the inverse height does.
  double nonlinearity(const LampBlock& lamp) const;
  /// Makes an inverse height the point it describes.
  void promote(LampBlock& lamp);

  /// Squared distance of two points by their joint covariance, of 3 degrees of freedom.
  double squared_distance(const LampBlock& point_a, const LampBlock& point_b) const;
  /// Makes one point of two that are the same: what is known of both goes into `kept`, `dropped` is removed.
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
  Index errors_size_ = 0;  // of CameraErrors, from kCameraEntry on: nothing, the centre's, or the tilt's behind it
  std::vector<ObservationRow> rows_;
};

}  // namespace azimuth
