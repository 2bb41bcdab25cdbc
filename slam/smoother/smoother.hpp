#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>
#include <variant>

#include "slam/geometry/wrong_rig.hpp"
#include "slam/smoother/bearing_graph.hpp"
#include "slam/smoother/front_tree.hpp"

namespace azimuth {

/// The most likely path and map given all odometry and bearings so far, and their uncertainty (mathematics VI.18,
/// VI.19).
///
/// The caller decides the data association and may change it at any time. Nothing is computed before optimise(). Copies
/// are cheap and share equal parts.
///
/// Thread contract: thread-bound. The same calls give the same bits.
class Smoother {
 public:
  /// The first pose (id 0) is a constant: see BearingGraph.
  explicit Smoother(const SmootherSettings& settings, const Pose2& T_map_first = {});

  // Measurements. The covariance of a motion must be positive definite.
  PoseId add_pose(const Motion& motion, const ByLag& by_lag = ByLag::Zero());
  BearingId add_bearing(double azimuth_rad, double sigma_rad, const std::optional<MeasuredElevation>& elevation = {},
                        const ByCentre& by_centre = ByCentre::Zero()) {
    return graph_.add_bearing(azimuth_rad, sigma_rad, elevation, by_centre);
  }

  // Data association and priors.
  /// Adds a landmark on the ray of bearing `first` and assigns the bearing to it.
  LandmarkId add_landmark(BearingId first);
  /// Adds a landmark of a saved map and the joint prior of the map: see BearingGraph.
  LandmarkId add_known_landmark(const SmoothedLandmark& landmark) { return graph_.add_known_landmark(landmark); }
  void remember(Remembered remembered);
  /// Assigns a bearing to a landmark; kOfNothing: to no landmark. A landmark that loses its last bearing is no unknown
  /// until a bearing is assigned to it again.
  void assign(BearingId bearing, LandmarkId landmark);
  /// Assigns all bearings of `gone` to `kept`.
  void merge(LandmarkId kept, LandmarkId gone);
  /// See BearingGraph.
  void use_prior(LandmarkId landmark, bool used);
  /// Removes poses and their bearings: see BearingGraph. The caller must call optimise() afterwards.
  void forget(std::span<const PoseId> poses);

  /// See BearingGraph. The caller must call optimise() afterwards.
  void begin_at(const BearingGraph::Values& values);

  struct Outcome {
    int iterations = 0;      ///< steps taken
    int damped = 0;          ///< number of these steps with damping
    bool converged = false;  ///< otherwise further iterations would lower the energy
  };
  /// Moves all unknowns from their current values towards the minimum of the energy.
  Outcome optimise() { return optimise(settings_.max_iterations); }
  Outcome optimise(int max_iterations);

  const BearingGraph& graph() const { return graph_; }
  const Pose2& newest_pose() const { return graph_.pose(graph_.poses() - 1); }
  /// Energy as of the last optimise(): half the squared residuals in standard deviations, with the robust kernel, plus
  /// the priors.
  double energy() const { return graph_.energy(); }
  /// Sets the robust kernel; it takes effect with the next optimise().
  void set_kernel(RobustKernel kernel, double width) {
    settings_.kernel = kernel;
    settings_.kernel_width = width;
    graph_.set_kernel(kernel, width);
  }

  struct PoseOf {
    PoseId id;
  };
  struct LandmarkOf {
    LandmarkId id;
  };
  using Unknown = std::variant<PoseOf, LandmarkOf>;
  /// Joint covariance, as of the last optimise(). A pose has the entries (x, y, heading) in the map, a landmark (alpha,
  /// rho). The first pose and a landmark that is no unknown have no entries.
  Eigen::MatrixXd covariance(std::span<const Unknown> unknowns) const;
  Eigen::Matrix3d pose_covariance(PoseId id) const;
  Eigen::Matrix3d newest_covariance() const { return pose_covariance(graph_.poses() - 1); }
  /// Covariance of (x, y) of a landmark that is_point() and has bearings.
  Eigen::Matrix2d point_covariance(LandmarkId id) const;
  /// Covariance of (x, y, height above the camera) of a landmark that is_point() and has elevations.
  Eigen::Matrix3d point_covariance_with_height(LandmarkId id) const;

  /// Covariance of all calibration values, as of the last optimise(); zero for values that are no unknowns.
  Eigen::Matrix<double, kCalibrations, kCalibrations> calibration_covariance() const;

  /// The ratio of actual to stated noise, estimated from the residuals and from the number of residuals that the
  /// unknowns take up. It is 1 when there are too few residuals. As of the last optimise().
  struct Noise {
    double ratio = 1.0;  ///< ratio of actual to stated standard deviation
    double told = 0.0;   ///< redundancy: number of residuals minus those that the unknowns take up
  };
  Noise bearing_noise() const;
  /// The ratio of actual to stated noise of odometry composed over `stride` poses at a time.
  Noise odometry_noise(int stride) const;
  /// What bearings and odometry tell about the calibration values, which need not be unknowns and must have no prior
  /// here, to first order and as of the last optimise() (mathematics VI.33).
  RigEvidence<kCalibrations> rig_evidence() const;
  /// Corrects odometry and azimuths so far: see BearingGraph. The caller must call optimise() afterwards.
  void correct(const Calibration& errors) { graph_.correct(errors); }
  /// Multiplies the standard deviations of all bearings and of all odometry so far. The caller must call optimise()
  /// afterwards.
  void scale_noise(double bearings, double odometry);
  /// See BearingGraph. The caller must call optimise() afterwards.
  void set_calibration_sigma(int which, double sigma) { graph_.set_calibration_sigma(which, sigma); }

  const FrontTree& factor() const { return factor_; }
  /// Discards the factor, so that the next optimise() linearises and orders everything anew.
  void start_factor_anew();

 private:
  template <typename SignedSum>
  double taken_up(const SignedSum& signed_sum) const;
  void untie_height(BearingId bearing);
  void tie_height(BearingId bearing);
  void mark_stale_terms();
  bool refresh();
  bool take_step(const Eigen::VectorXd& step, double energy_before);
  bool take_shorter_step(const Eigen::VectorXd& step, double energy_before);
  bool take_damped_step(double energy_before, int& tries);

  SmootherSettings settings_;
  BearingGraph graph_;
  FrontTree factor_;
  double damping_ = 0.0;
};

}  // namespace azimuth
