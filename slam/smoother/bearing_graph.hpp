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

/// Poses, landmarks, what was measured between them, and which bearing is taken to be of which landmark: the sum of
/// squares (rather, of energies) whose minimum is looked for.
///
/// Measurements never change; which landmark a bearing is of may. Copies share what is equal. A landmark that no
/// bearing is of is no unknown.
///
/// Thread contract: thread-bound.
class BearingGraph : public NormalEquations {
 public:
  /// The first pose is a constant: it fixes the map's frame. What is known of it to some standard deviation is a motion
  /// to a second pose, of that covariance.
  BearingGraph(const SmootherSettings& settings, const Pose2& T_map_first);

  /// A pose at the end of `motion` from the newest one; `motion.covariance` must be positive definite.
  PoseId add_pose(const Motion& motion, const ByLag& by_lag = ByLag::Zero());
  /// Of the newest pose, of no landmark.
  BearingId add_bearing(double azimuth_rad, double sigma_rad, const std::optional<MeasuredElevation>& elevation = {},
                        const ByCentre& by_centre = ByCentre::Zero());
  /// On the ray of a bearing as it lies now, at the distance that the prior says. The bearing is not of it yet.
  LandmarkId add_landmark(BearingId first);
  /// Where it is said to be. It is an unknown although no bearing is of it: remember() is to follow.
  LandmarkId add_known_landmark(const SmoothedLandmark& landmark);
  /// At most once.
  void remember(Remembered remembered);
  /// How well one of calibration:: is known before, where it is an unknown: more or less than was said at first.
  void set_calibration_sigma(int which, double sigma);
  double calibration_sigma(int which) const { return calibration_sigma_[static_cast<std::size_t>(which)]; }
  /// All bearings so far, and all that odometry has said, turn out to be so many times as noisy.
  void scale_noise(double bearings, double odometry);
  /// What is known of a new landmark's distance before any bearing tells: each has this, until it is left out. A trace
  /// of it stays even then (prior_information()).
  void use_prior(LandmarkId landmark, bool used);
  /// kOfNothing: of none.
  void assign(BearingId bearing, LandmarkId landmark);
  /// These poses and their bearings are no more; what odometry says of the way into one and out of it becomes what it
  /// says of the way past it. Poses, bearings and blocks that are left are numbered anew, in the order that they have;
  /// landmarks stay. The first pose, the newest one and that of what is remembered cannot be forgotten.
  void forget(std::span<const PoseId> poses);

  std::int32_t poses() const { return poses_.size(); }
  std::int32_t bearings() const { return bearings_.size(); }
  std::int32_t landmarks() const { return landmarks_.size(); }
  const Pose2& pose(PoseId id) const { return poses_[id].state.T_map_body; }
  const SmoothedPose& smoothed_pose(PoseId id) const { return poses_[id].state; }
  const SmoothedLandmark& landmark(LandmarkId id) const { return landmarks_[id].state; }
  const std::vector<BearingId>& bearings_of(LandmarkId id) const { return landmarks_[id].bearings; }
  bool is_known(LandmarkId id) const { return landmarks_[id].known; }  ///< from before
  bool has_prior(LandmarkId id) const { return landmarks_[id].prior && !landmarks_[id].known; }
  double prior_mean_per_m(LandmarkId id) const { return landmarks_[id].prior_mean_per_m; }
  /// Of its inverse distance [m^2]: how much the prior says of it, left out or not. Nothing of a known one.
  double prior_information(LandmarkId id) const;
  /// Of its inverse distance [m^2]: how much those of its bearings say that fit, with poses taken as known, as of the
  /// last evaluate().
  double told_information(LandmarkId id) const;
  /// Else it is none: no bearing is of it.
  bool is_unknown(LandmarkId id) const { return landmarks_[id].known || !landmarks_[id].bearings.empty(); }
  const Remembered& remembered() const { return *remembered_; }
  const OdometryMeasurement& odometry_to(PoseId id) const { return odometry_[id]; }  ///< from the pose before
  const BearingMeasurement& bearing(BearingId id) const { return bearings_[id]; }
  BearingId first_bearing_of(PoseId id) const {
    return id < poses_.size() ? poses_[id].first_bearing : bearings_.size();
  }
  LandmarkId landmark_of(BearingId id) const { return links_[id].landmark; }
  /// How high a landmark is above the camera [m]; NaN when no elevation of it was measured, or it is no point.
  double height_m(LandmarkId id) const;
  /// Squared, in standard deviations, as of the last evaluate(); 0 when it is of no landmark. Of the azimuth, as all
  /// that is said of bearings here unless elevations are named.
  double chi2_of(BearingId id) const;
  double elevation_chi2_of(BearingId id) const;  ///< likewise; 0 when none was measured
  /// d(residual) / d(alpha, rho) of its landmark, in standard deviations, as of the last evaluate().
  const Eigen::Vector2d& by_landmark_of(BearingId id) const { return links_[id].by_landmark; }
  double odometry_chi2(PoseId id) const { return 2.0 * poses_[id].energy; }  ///< likewise, of odometry_to()
  const Calibration& calibration() const { return calibration_; }
  /// Where the camera is when the robot is there, by the calibration of the moment; turned as the robot. And back.
  SmoothedPose camera_at(const SmoothedPose& body) const {
    return body.moved({calibration_[calibration::camera_x], calibration_[calibration::camera_y], 0.0});
  }
  Pose2 body_at(const Pose2& T_map_camera) const {
    return T_map_camera * Pose2{-calibration_[calibration::camera_x], -calibration_[calibration::camera_y], 0.0};
  }

  Block block_of_pose(PoseId id) const { return poses_[id].block; }
  Block block_of_landmark(LandmarkId id) const { return landmarks_[id].block; }
  /// Of the height of a landmark that elevations were measured of.
  Block block_of_height(LandmarkId id) const { return heights_[landmarks_[id].height].block; }
  /// How many bearings that are of it have an elevation.
  int elevations_of(LandmarkId id) const {
    return landmarks_[id].height == kNoHeight ? 0 : heights_[landmarks_[id].height].elevations;
  }
  /// Whether a bearing that is of a landmark says something of its height.
  const MeasuredElevation& elevation(BearingId id) const { return elevations_[bearings_[id].elevation].measured; }
  bool has_elevation(BearingId id) const { return bearings_[id].elevation != kNoElevation; }
  static constexpr Block kCalibrationBlock = 0;
  Block blocks() const { return blocks_.size(); }
  /// Of one of calibration::; negative: it is no unknown. The calibration's rows are the first ones.
  int calibration_row(int which) const { return calibration_row_[static_cast<std::size_t>(which)]; }

  /// Makes residuals and derivatives those of the moment, where something has changed, and sums them up.
  void evaluate();
  double energy() const { return energy_; }
  /// Half the squared residuals, of each bearing at most `most`, and the priors': whatever the kernel, as of the last
  /// evaluate().
  double bounded_energy(double most) const;
  /// Residuals of one kind in standard deviations, as of the last evaluate(), weighted by the kernel.
  struct Misfit {
    double chi2 = 0.0;
    int residuals = 0;
  };
  Misfit misfit_of_bearings() const;
  /// Of what it says over so many poses at a time: errors that are small from image to image and of one sign add up.
  Misfit misfit_of_odometry(int stride) const;
  /// Derivatives of those residuals, each with a sign drawn by `seed`, summed: v, whose v^T H^-1 v is on average how
  /// many of the residuals the unknowns have taken up (Hutchinson's estimate of a trace).
  Eigen::VectorXd signed_sum_of_bearings(std::uint64_t seed) const;
  Eigen::VectorXd signed_sum_of_odometry(std::uint64_t seed, int stride) const;
  /// From the next evaluate() on.
  void set_kernel(RobustKernel kernel, double width);
  const Eigen::VectorXd& gradient() const { return gradient_; }
  /// Pairs of blocks with a term whose derivatives are no longer those of the factor; of one alone when they are the
  /// same. Emptied by the call.
  std::vector<std::pair<Block, Block>> take_stale() { return std::exchange(stale_, {}); }

  /// All unknowns.
  struct Values {
    std::vector<SmoothedPose> poses;
    std::vector<SmoothedLandmark> landmarks;
    std::vector<double> tangents;  ///< of each landmark: its height times rho; NaN: it has none
    Calibration calibration = Calibration::Zero();
  };
  Values values() const;
  /// Puts all of them elsewhere. Poses and landmarks must be as many; the first pose stays where it is.
  void begin_at(const Values& values);
  /// What a step has moved, as it was before.
  struct Moved {
    std::vector<std::pair<PoseId, SmoothedPose>> poses;
    struct Landmark {
      LandmarkId id;
      SmoothedLandmark state;
      double prior_mean_per_m;
    };
    std::vector<Landmark> landmarks;
    std::vector<double> tangents;  ///< of all heights
    Calibration calibration = Calibration::Zero();
  };
  /// What would go less far than `stands_below` stays, and all its terms with it.
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
    BearingId first_bearing = 0;  // up to that of the next pose
    bool moved = true;
    // Of the odometry from the pose before
    Eigen::Vector3d relative = Eigen::Vector3d::Zero();
    // Derivatives of the energy: by `relative`, by the pose before, by this one
    Eigen::Vector3d pull = Eigen::Vector3d::Zero(), pull_start = pull, pull_end = pull;
    Eigen::Vector3d factor_relative = Eigen::Vector3d::Zero();  // as in the factor
    double energy = 0.0;
  };
  struct LandmarkEntry {
    SmoothedLandmark state;
    Block block = 0;
    bool moved = true;
    bool known = false;  // from before
    bool prior = true;
    double prior_mean_per_m = 0.0;  // of rho, in the chart of the moment
    std::int32_t height = kNoHeight;
    std::vector<BearingId> bearings;
  };
  static constexpr std::int32_t kNoHeight = -1;
  /// A height is an unknown of its own, since few landmarks have one.
  struct HeightEntry {
    LandmarkId landmark = kOfNothing;
    Block block = 0;
    double tangent = 0.0;  // times the distance: the height
    int elevations = 0;    // that were measured of it
  };
  /// A second row of a bearing; derivatives and residual in standard deviations.
  struct ElevationEntry {
    MeasuredElevation measured;
    double residual = 0.0, weight = 0.0, energy = 0.0, by_tangent = 0.0;
    Eigen::Vector3d by_pose = Eigen::Vector3d::Zero();
    Eigen::Vector2d by_landmark = Eigen::Vector2d::Zero();
    // As in the factor.
    double factor_weight = 0.0;
    Eigen::Matrix<double, 5, 1> factor_derivatives = Eigen::Matrix<double, 5, 1>::Zero();
  };
  /// Which landmark a bearing is of, and what follows; derivatives and residual in standard deviations.
  struct Link {
    LandmarkId landmark = kOfNothing;
    bool changed = false;
    double residual = 0.0, weight = 0.0, energy = 0.0;
    Eigen::Vector3d by_pose = Eigen::Vector3d::Zero();
    Eigen::Vector2d by_landmark = Eigen::Vector2d::Zero();
    // As in the factor
    float factor_weight = 0.0F;
    std::array<float, 4> factor_derivatives{};  // by position and landmark
  };

  static constexpr std::int32_t kForgotten = -1;
  // Times as wide, and so no rival of any bearing: nearer than 0.2 m to where it was seen from is still unlikely.
  static constexpr double kTraceOfPrior_sigmas = 25.0;

  OdometryMeasurement odometry_over(PoseId start, PoseId end) const;
  Block add_block(Kind kind, std::int32_t id, int size);
  void keep_pose(const BearingGraph& before, PoseId id, const std::optional<OdometryMeasurement>& way,
                 std::vector<BearingId>& bearing_now);
  void keep_remembered(const std::vector<PoseId>& pose_now);
  void list_remembered_blocks();
  BearingId end_of_bearings(PoseId pose) const { return first_bearing_of(pose + 1); }
  bool calibrates(int which) const { return calibration_row(which) >= 0; }
  /// By what the azimuth is more than was measured, by the calibration of the moment.
  double camera_error_rad(const BearingMeasurement& measured) const {
    return calibration_[calibration::yaw] + measured.by_centre.dot(calibration_.segment<2>(calibration::centre_x));
  }
  using ByCamera = Eigen::Matrix<double, kCameraCalibrations, 1>;
  /// Of a bearing's residual, in standard deviations.
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

  // Heights.
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
  std::vector<Block> remembered_blocks_;  // of its entries, in their order
  int rows_ = 0;
  double energy_ = 0.0;
  Eigen::VectorXd gradient_;
  std::vector<std::pair<Block, Block>> stale_;
};

}  // namespace azimuth
