#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "slam/geometry/motion.hpp"
#include "slam/smoother/factors.hpp"
#include "slam/smoother/measurements.hpp"
#include "slam/smoother/normal_equations.hpp"
#include "slam/smoother/odometry_measurement.hpp"
#include "slam/smoother/shared_pages.hpp"
#include "slam/smoother/smoother_settings.hpp"

namespace azimuth {

/// The factor graph of the smoother: poses, landmarks, calibration, the measurements between them, and the data
/// association (which landmark each bearing belongs to). Its energy is the sum of all terms; the smoother minimises it.
///
/// Apart from scale_noise(), measurements never change; the data association may. Copies share equal parts. A landmark
/// without bearings is no unknown, unless it comes from a saved map.
///
/// Thread contract: thread-bound.
class BearingGraph : public NormalEquations {
 public:
  /// The first pose is a constant and fixes the map's frame. To express that the first pose is uncertain, add a second
  /// pose by a motion of that covariance.
  BearingGraph(const SmootherSettings& settings, const Pose2& T_map_first);

  /// Adds a pose at the end of `motion` from the newest pose. `motion.covariance` must be positive definite.
  PoseId add_pose(const Motion& motion, const ByLag& by_lag = ByLag::Zero());
  /// Adds a bearing from the newest pose. The bearing belongs to no landmark yet.
  BearingId add_bearing(double azimuth_rad, double sigma_rad, const std::optional<MeasuredElevation>& elevation = {},
                        const ByCentre& by_centre = ByCentre::Zero());
  /// Adds a landmark on the current ray of bearing `first`, at the mean distance of the prior. The bearing is not yet
  /// assigned to the landmark.
  LandmarkId add_landmark(BearingId first);
  /// Adds a landmark of a saved map at the given place. The landmark is an unknown even without bearings. The caller
  /// must call remember() afterwards, which adds the prior of the landmark.
  LandmarkId add_known_landmark(const SmoothedLandmark& landmark);
  /// Adds the joint prior from a saved map. It may be called at most once.
  void remember(Remembered remembered);
  /// Sets the prior standard deviation of the value `which` of calibration::, which must be an unknown.
  void set_calibration_sigma(int which, double sigma);
  double calibration_sigma(int which) const { return calibration_sigma_[static_cast<std::size_t>(which)]; }
  /// Multiplies the standard deviations of all azimuths and of all odometry so far by these factors.
  void scale_noise(double bearings, double odometry);
  /// Switches the prior of a new landmark's inverse distance on or off. The prior is on at first. When it is off, a
  /// weak remnant of it stays (see prior_information()).
  void use_prior(LandmarkId landmark, bool used);
  /// Assigns the bearing to the landmark; kOfNothing: to no landmark.
  void assign(BearingId bearing, LandmarkId landmark);
  /// Removes these poses and their bearings. The odometry into and out of a removed pose becomes one composed
  /// measurement. The remaining poses, bearings and blocks are renumbered in their order; landmarks keep their numbers.
  /// The first pose, the newest pose and the pose of the remembered map cannot be removed.
  void forget(std::span<const PoseId> poses);

  std::int32_t poses() const { return poses_.size(); }
  std::int32_t bearings() const { return bearings_.size(); }
  std::int32_t landmarks() const { return landmarks_.size(); }
  const Pose2& pose(PoseId id) const { return poses_[id].state.T_map_body; }
  const SmoothedPose& smoothed_pose(PoseId id) const { return poses_[id].state; }
  const SmoothedLandmark& landmark(LandmarkId id) const { return landmarks_[id].state; }
  const std::vector<BearingId>& bearings_of(LandmarkId id) const { return landmarks_[id].bearings; }
  bool is_known(LandmarkId id) const { return landmarks_[id].known; }  ///< whether the landmark comes from a saved map
  bool has_prior(LandmarkId id) const { return landmarks_[id].prior && !landmarks_[id].known; }
  double prior_mean_per_m(LandmarkId id) const { return landmarks_[id].prior_mean_per_m; }
  /// Information of the landmark's prior on its inverse distance [m^2], whether the prior is on or off. It is zero for
  /// a landmark of a saved map.
  double prior_information(LandmarkId id) const;
  /// Information of the inverse distance [m^2] from those of the landmark's bearings that fit, with the poses taken as
  /// known, as of the last evaluate().
  double told_information(LandmarkId id) const;
  /// Whether the landmark is an unknown: it comes from a saved map or has bearings.
  bool is_unknown(LandmarkId id) const { return landmarks_[id].known || !landmarks_[id].bearings.empty(); }
  const Remembered& remembered() const { return *remembered_; }
  /// The odometry from the pose before to this pose.
  const OdometryMeasurement& odometry_to(PoseId id) const { return odometry_[id]; }
  const BearingMeasurement& bearing(BearingId id) const { return bearings_[id]; }
  BearingId first_bearing_of(PoseId id) const {
    return id < poses_.size() ? poses_[id].first_bearing : bearings_.size();
  }
  LandmarkId landmark_of(BearingId id) const { return links_[id].landmark; }
  /// Height of the landmark above the camera [m]; NaN when no elevation of the landmark was measured or the landmark is
  /// no point (rho <= 0).
  double height_m(LandmarkId id) const;
  /// Squared residual of the azimuth in standard deviations, as of the last evaluate(); 0 when the bearing belongs to
  /// no landmark. Everything said of bearings here refers to the azimuth unless elevations are named.
  double chi2_of(BearingId id) const;
  double elevation_chi2_of(BearingId id) const;  ///< squared residual of the elevation; 0: not measured
  /// d(residual of the azimuth) / d(alpha, rho of its landmark), in standard deviations, as of the last evaluate().
  const Eigen::Vector2d& by_landmark_of(BearingId id) const { return links_[id].by_landmark; }
  double odometry_chi2(PoseId id) const { return 2.0 * poses_[id].energy; }  ///< squared residual of odometry_to()
  const Calibration& calibration() const { return calibration_; }
  /// The camera's position for a robot pose, by the current calibration, with the robot's heading (the camera's yaw is
  /// not included). body_at() is the inverse.
  SmoothedPose camera_at(const SmoothedPose& body) const {
    return body.moved({calibration_[calibration::camera_x], calibration_[calibration::camera_y], 0.0});
  }
  SmoothedPose camera_at(PoseId id) const {
    return calibration_.tail<2>().isZero(0.0) ? poses_[id].state : camera_at(poses_[id].state);
  }
  Pose2 body_at(const Pose2& T_map_camera) const {
    return T_map_camera * Pose2{-calibration_[calibration::camera_x], -calibration_[calibration::camera_y], 0.0};
  }

  Block block_of_pose(PoseId id) const { return poses_[id].block; }
  Block block_of_landmark(LandmarkId id) const { return landmarks_[id].block; }
  /// Block of the height of a landmark that has elevations.
  Block block_of_height(LandmarkId id) const { return heights_[landmarks_[id].height].block; }
  /// Number of the landmark's bearings that have an elevation.
  int elevations_of(LandmarkId id) const {
    return landmarks_[id].height == kNoHeight ? 0 : heights_[landmarks_[id].height].elevations;
  }
  /// The measured elevation of a bearing that has one (has_elevation()).
  const MeasuredElevation& elevation(BearingId id) const { return elevations_[bearings_[id].elevation].measured; }
  bool has_elevation(BearingId id) const { return bearings_[id].elevation != kNoElevation; }
  static constexpr Block kCalibrationBlock = 0;
  Block blocks() const { return blocks_.size(); }
  /// Row of the value `which` of calibration:: in the normal matrix; negative when the value is no unknown. The
  /// calibration's rows are the first ones.
  int calibration_row(int which) const { return calibration_row_[static_cast<std::size_t>(which)]; }

  /// Recomputes residuals and derivatives where an unknown or the data association has changed, and sums energy and
  /// gradient.
  void evaluate();
  double energy() const { return energy_; }
  /// The energy with each azimuth's kernel replaced by half its squared residual, at most `most`, so that the value
  /// does not depend on the azimuths' kernel. As of the last evaluate().
  double bounded_energy(double most) const;
  /// Sum of the squared residuals of one kind in standard deviations, weighted by the kernel, as of the last
  /// evaluate().
  struct Misfit {
    double chi2 = 0.0;
    int residuals = 0;
  };
  Misfit misfit_of_bearings() const;
  /// Misfit of odometry composed over `stride` poses at a time. Errors that are small from image to image but of one
  /// sign add up over longer ways.
  Misfit misfit_of_odometry(int stride) const;
  /// Sum v of the derivatives of the residuals that misfit_of_bearings() or misfit_of_odometry() counts, each with a
  /// random sign drawn by `seed`. The mean of v^T H^-1 v is the number of residuals that the unknowns take up
  /// (Hutchinson's trace estimate).
  Eigen::VectorXd signed_sum_of_bearings(std::uint64_t seed) const;
  Eigen::VectorXd signed_sum_of_odometry(std::uint64_t seed, int stride) const;
  /// Derivatives of the energy by the calibration values, which need not be unknowns, as of the last evaluate().
  struct ByCalibration {
    Calibration slope = Calibration::Zero();
    Eigen::Matrix<double, kCalibrations, kCalibrations> curvature =
        Eigen::Matrix<double, kCalibrations, kCalibrations>::Zero();
    Eigen::Matrix<double, Eigen::Dynamic, kCalibrations> mixed;  ///< d2 energy / (d unknowns d calibration)
  };
  ByCalibration by_calibration() const;
  /// Corrects odometry and azimuths so far for these errors of the rig, and adds the camera's position to
  /// calibration(). None of the values may be an unknown.
  void correct(const Calibration& errors);
  /// Sets the robust kernel; it takes effect with the next evaluate().
  void set_kernel(RobustKernel kernel, double width);
  const Eigen::VectorXd& gradient() const { return gradient_; }
  /// Returns and clears the pairs of blocks that share a term whose derivatives have moved away from those in the
  /// factor. A pair of twice the same block stands for a term of that block alone.
  std::vector<std::pair<Block, Block>> take_stale() { return std::exchange(stale_, {}); }

  /// Values of all unknowns.
  struct Values {
    std::vector<SmoothedPose> poses;
    std::vector<SmoothedLandmark> landmarks;
    std::vector<double> tangents;  ///< per landmark, height times rho; NaN: the landmark has no height
    Calibration calibration = Calibration::Zero();
  };
  Values values() const;
  /// Sets poses, landmarks and calibration to `values`, which must have as many poses and landmarks as the graph. The
  /// first pose and the heights stay as they are.
  void begin_at(const Values& values);
  /// The values of the moved unknowns before a step, for move_back().
  struct Moved {
    std::vector<std::pair<PoseId, SmoothedPose>> poses;
    struct Landmark {
      LandmarkId id;
      SmoothedLandmark state;
      double prior_mean_per_m;
    };
    std::vector<Landmark> landmarks;
    std::vector<double> tangents;  ///< tangents of all heights
    Calibration calibration = Calibration::Zero();
  };
  /// Applies `step`. A pose or landmark stays when all components of its step are below `stands_below` [m, rad, 1/m];
  /// its terms need no new evaluation then.
  Moved move(const Eigen::VectorXd& step, double stands_below = 0.0);
  void move_back(const Moved& moved);

  int rows() const override { return rows_; }
  int size(Block block) const override;
  int first_row(Block block) const override { return blocks_[block].first_row; }
  std::uint8_t rank(Block block) const override;
  void append_neighbours(Block block, std::vector<Block>& out) const override;
  void add_terms(Block block, FrontMatrix& front) override;

 private:
  enum class Kind : std::uint8_t { calibration, pose, landmark, height };
  struct BlockEntry {
    Kind kind = Kind::calibration;
    std::int32_t id = 0;
    std::int32_t first_row = 0;
  };
  struct PoseEntry {
    SmoothedPose state;
    Block block = 0;
    BearingId first_bearing = 0;  // the bearings of the pose end before the next pose's first
    bool moved = true;
    // The odometry term from the pose before to this pose.
    Eigen::Vector3d relative = Eigen::Vector3d::Zero();
    // Derivatives of the term's energy by `relative`, by the pose before and by this pose.
    Eigen::Vector3d pull = Eigen::Vector3d::Zero(), pull_start = pull, pull_end = pull;
    Eigen::Vector3d factor_relative = Eigen::Vector3d::Zero();  // `relative` at the last factorisation
    double energy = 0.0;
  };
  struct LandmarkEntry {
    SmoothedLandmark state;
    Block block = 0;
    bool moved = true;
    bool known = false;  // comes from a saved map
    bool prior = true;
    double prior_mean_per_m = 0.0;  // prior mean of rho in the current chart
    std::int32_t height = kNoHeight;
    std::vector<BearingId> bearings;
  };
  static constexpr std::int32_t kNoHeight = -1;
  /// Height of a landmark above the camera. A height has a block of its own, since few landmarks have one.
  struct HeightEntry {
    LandmarkId landmark = kOfNothing;
    Block block = 0;
    double tangent = 0.0;  // height times rho
    int elevations = 0;    // number of the landmark's bearings with an elevation
  };
  /// The elevation of a bearing, a second residual beside its azimuth. Derivatives and residual are in standard
  /// deviations.
  struct ElevationEntry {
    MeasuredElevation measured;
    double residual = 0.0, weight = 0.0, energy = 0.0, by_tangent = 0.0;
    Eigen::Vector3d by_pose = Eigen::Vector3d::Zero();
    Eigen::Vector2d by_landmark = Eigen::Vector2d::Zero();
    // Values at the last factorisation.
    double factor_weight = 0.0;
    Eigen::Matrix<double, 5, 1> factor_derivatives = Eigen::Matrix<double, 5, 1>::Zero();
  };
  /// The data association of a bearing, and the term of its azimuth. Derivatives and residual are in standard
  /// deviations.
  struct Link {
    LandmarkId landmark = kOfNothing;
    bool changed = false;
    double residual = 0.0, weight = 0.0, energy = 0.0;
    Eigen::Vector3d by_pose = Eigen::Vector3d::Zero();
    Eigen::Vector2d by_landmark = Eigen::Vector2d::Zero();
    // Values at the last factorisation.
    float factor_weight = 0.0F;
    std::array<float, 4> factor_derivatives{};  // by position (2) and landmark (2)
  };

  static constexpr std::int32_t kForgotten = -1;
  // Factor on the prior's standard deviation for a prior that is off. So wide a prior competes with no bearing, yet it
  // still makes it unlikely that a landmark lies nearer than 0.2 m to the place where it was seen first.
  static constexpr double kTraceOfPrior_sigmas = 25.0;

  OdometryMeasurement odometry_over(PoseId start, PoseId end) const;
  Block add_block(Kind kind, std::int32_t id, int size);
  void keep_pose(const BearingGraph& before, PoseId id, const std::optional<OdometryMeasurement>& way,
                 std::vector<BearingId>& bearing_now);
  void keep_remembered(const std::vector<PoseId>& pose_now);
  void list_remembered_blocks();
  BearingId end_of_bearings(PoseId pose) const { return first_bearing_of(pose + 1); }
  bool calibrates(int which) const { return calibration_row(which) >= 0; }
  /// The azimuth in the robot's frame minus the measured one, by the current calibration of the camera's yaw and of the
  /// image's centre.
  double camera_error_rad(const BearingMeasurement& measured) const {
    return calibration_[calibration::yaw] + measured.by_centre.dot(calibration_.segment<2>(calibration::centre_x));
  }
  using ByCamera = Eigen::Matrix<double, kCameraCalibrations, 1>;
  /// d(residual of the azimuth) / d(camera calibration), in standard deviations.
  static ByCamera by_camera(const Link& link, const BearingMeasurement& measured) {
    const double per_sigma = -1.0 / measured.sigma_rad;
    ByCamera by;
    by << per_sigma, per_sigma * measured.by_centre, link.by_pose.head<2>();
    return by;
  }

  void move_landmark(LandmarkEntry& landmark, const Eigen::Vector2d& by, const Eigen::VectorXd& step);
  void take_chart_along(LandmarkEntry& landmark, const Eigen::Vector2d& shift_m);
  void evaluate_odometry(PoseId pose);
  void evaluate_bearing(BearingId bearing);
  bool is_stale(const PoseEntry& pose, const OdometryMeasurement& measured) const;
  bool is_stale(const Link& link, const BearingMeasurement& measured) const;
  void sum_odometry(PoseId pose);
  void sum_bearing(BearingId bearing);
  void add_pull(const Link& link, const BearingMeasurement& measured, double pull, Eigen::VectorXd& sum) const;
  void sum_priors();
  void sum_remembered();

  bool is_remembered(Block block) const;

  // Terms of elevations, see bearing_graph_heights.cpp.
  void begin_height(BearingId first, LandmarkId landmark);
  void count_elevation(LandmarkId landmark, int more);
  void move_heights(const Eigen::VectorXd& step);
  void evaluate_elevation(BearingId bearing);
  bool is_stale(const ElevationEntry& elevation) const;
  void sum_elevation(BearingId bearing);
  void append_height_neighbours(const HeightEntry& height, std::vector<Block>& out) const;
  void add_height_terms(const HeightEntry& height, FrontMatrix& front);
  void add_elevation(BearingId bearing, FrontMatrix& front);

  void add_pose_terms(PoseId pose, FrontMatrix& front);
  void add_landmark_terms(LandmarkId landmark, FrontMatrix& front);
  void add_calibration_terms(FrontMatrix& front) const;
  void append_remembered(Block block, std::vector<Block>& out) const;
  void add_remembered(Block block, FrontMatrix& front) const;
  void add_odometry(PoseId pose, FrontMatrix& front);
  void add_bearing(BearingId bearing, FrontMatrix& front);
  void add_camera(const Link& link, const BearingMeasurement& measured, int landmark_row, int pose_row,
                  FrontMatrix& front) const;
  bool comes_later(const FrontMatrix& front, Block block, int row) const;

  SmootherSettings settings_;
  std::array<int, kCalibrations> calibration_row_{};  // -1: no unknown
  std::array<double, kCalibrations> calibration_sigma_{};
  int calibration_size_ = 0;
  bool calibrates_odometry_ = false, calibrates_camera_ = false;
  Calibration calibration_ = Calibration::Zero();
  bool calibration_moved_ = true;

  SharedPages<BlockEntry> blocks_;
  SharedPages<PoseEntry> poses_;
  SharedPages<OdometryMeasurement> odometry_;  // one for each pose
  SharedPages<BearingMeasurement> bearings_;
  SharedPages<Link> links_;  // one for each bearing
  SharedPages<LandmarkEntry, 8> landmarks_;
  SharedPages<HeightEntry, 8> heights_;
  SharedPages<ElevationEntry> elevations_;
  std::shared_ptr<const Remembered> remembered_ = std::make_shared<Remembered>();
  std::vector<Block> remembered_blocks_;  // blocks of the remembered entries, in their order
  int rows_ = 0;
  double energy_ = 0.0;
  Eigen::VectorXd gradient_;
  std::vector<std::pair<Block, Block>> stale_;
};

}  // namespace azimuth
