#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>
#include <variant>

#include "slam/smoother/bearing_graph.hpp"
#include "slam/smoother/front_tree.hpp"

namespace azimuth {

/// The likeliest path and map given all odometry and bearings so far, and how uncertain both are (SPEC VI.18, VI.19).
///
/// Which bearing is of which landmark is decided elsewhere, and can be changed at any time. Nothing is computed before
/// optimise(). Copies are cheap, and share what they have in common.
///
/// Thread contract: thread-bound. Same calls, same bits.
class Smoother {
 public:
  /// The first pose, of id 0, is a constant: see BearingGraph.
  explicit Smoother(const SmootherSettings& settings, const Pose2& T_map_first = {});

  // What was measured. Motions must have a covariance that is positive definite.
  PoseId add_pose(const Motion& motion, const ByLag& by_lag = ByLag::Zero());
  BearingId add_bearing(double azimuth_rad, double sigma_rad, const std::optional<MeasuredElevation>& elevation = {},
                        const ByCentre& by_centre = ByCentre::Zero()) {
    return graph_.add_bearing(azimuth_rad, sigma_rad, elevation, by_centre);
  }

  // What it is of.
  /// A landmark on the bearing's ray, with that bearing.
  LandmarkId add_landmark(BearingId first);
  /// What is known from before: see BearingGraph. It is kept beside all that is seen.
  LandmarkId add_known_landmark(const SmoothedLandmark& landmark) { return graph_.add_known_landmark(landmark); }
  void remember(Remembered remembered);
  /// kOfNothing: of none. A landmark of no bearing is left out, and comes back with its next one.
  void assign(BearingId bearing, LandmarkId landmark);
  /// All bearings of `gone` become those of `kept`.
  void merge(LandmarkId kept, LandmarkId gone);
  /// See BearingGraph.
  void use_prior(LandmarkId landmark, bool used);
  /// What is no longer worth keeping: see BearingGraph. optimise() is to follow.
  void forget(std::span<const PoseId> poses);

  /// See BearingGraph. optimise() is to follow.
  void begin_at(const BearingGraph::Values& values);

  struct Outcome {
    int iterations = 0;      ///< steps taken
    int damped = 0;          ///< of these, with damping
    bool converged = false;  ///< else more iterations would lower the energy further
  };
  /// Moves all unknowns towards the minimum, from where they are.
  Outcome optimise() { return optimise(settings_.max_iterations); }
  Outcome optimise(int max_iterations);

  const BearingGraph& graph() const { return graph_; }
  const Pose2& newest_pose() const { return graph_.pose(graph_.poses() - 1); }
  /// As of the last optimise(): half the squared residuals in standard deviations, by the robust kernel, and the
  /// priors'.
  double energy() const { return graph_.energy(); }
  /// Listens to bearings that fit badly in another way, from the next optimise() on.
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
  /// Joint covariance, as of the last optimise(): a pose is (x, y, heading) in the map, a landmark its (alpha, rho), or
  /// nothing when no bearing is of it. The first pose has none.
  Eigen::MatrixXd covariance(std::span<const Unknown> unknowns) const;
  Eigen::Matrix3d pose_covariance(PoseId id) const;
  Eigen::Matrix3d newest_covariance() const { return pose_covariance(graph_.poses() - 1); }
  /// (x, y) of a landmark that is_point() and has bearings.
  Eigen::Matrix2d point_covariance(LandmarkId id) const;
  /// (x, y, height) of one that has elevations as well; height is above the camera.
  Eigen::Matrix3d point_covariance_with_height(LandmarkId id) const;

  /// Of all calibrations, likewise; zero for those that are no unknowns.
  Eigen::Matrix<double, kCalibrations, kCalibrations> calibration_covariance() const;

  /// How noisy bearings and odometry are, times what was said of them, by their residuals and how many of those the
  /// unknowns have taken up; 1 where nothing tells. As of the last optimise().
  struct Noise {
    double ratio = 1.0;  ///< of standard deviations
    double told = 0.0;   ///< by how many residuals beyond the unknowns
  };
  Noise bearing_noise() const;
  /// By what odometry says of the ways over so many poses.
  Noise odometry_noise(int stride) const;
  /// They are so many times as noisy as was said: optimise() is to follow.
  void scale_noise(double bearings, double odometry);
  /// See BearingGraph. optimise() is to follow.
  void set_calibration_sigma(int which, double sigma) { graph_.set_calibration_sigma(which, sigma); }

  const FrontTree& factor() const { return factor_; }
  /// For comparison: everything linearised here, and ordered anew.
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
  double damping_ = 0.0;  // of the last damped step
};

}  // namespace azimuth
