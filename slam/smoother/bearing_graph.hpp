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
#include "slam/smoother/normal_equations.hpp"
#include "slam/smoother/odometry_measurement.hpp"
#include "slam/smoother/shared_pages.hpp"
#include "slam/smoother/smoother_settings.hpp"

namespace azimuth {

// Numbers given in the order of arrival. Until the graph forgets some they are never those of something else.
using PoseId = std::int32_t;
using BearingId = std::int32_t;
using LandmarkId = std::int32_t;
inline constexpr LandmarkId kOfNothing = -1;

/// What fits worse, squared in standard deviations, the robust kernel hardly listens to.
inline constexpr double kFitsChi2 = 9.0;

/// Errors of odometry, and the camera's yaw.
inline constexpr int kCalibrations = kOdometryCalibrations + 1;
using Calibration = Eigen::Matrix<double, kCalibrations, 1>;

/// A direction from a pose.
struct BearingMeasurement {
  PoseId pose = 0;
  double azimuth_rad = 0.0, sigma_rad = 1.0;
};

/// What is known of landmarks and a pose from before, all together (SPEC VI.18): a Gaussian of, one after another, the
/// pose's (x, y, heading) and each landmark's (alpha, rho).
struct Remembered {
  PoseId pose = 0;  ///< 0, the first one: none; it has no entries then
  std::vector<LandmarkId> landmarks;
  Eigen::VectorXd mean;
  Eigen::MatrixXd information;  ///< inverse covariance
};

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
  PoseId add_pose(const Motion& motion);
  /// Of the newest pose, of no landmark.
  BearingId add_bearing(double azimuth_rad, double sigma_rad);
  /// On the ray of a bearing as it lies now, at the distance that the prior says. The bearing is not of it yet.
  LandmarkId add_landmark(BearingId first);
  /// Where it is said to be. It is an unknown although no bearing is of it: remember() is to follow.
  LandmarkId add_known_landmark(const SmoothedLandmark& landmark);
  /// At most once.
  void remember(Remembered remembered);
  /// What is known of a new landmark's distance before any bearing tells: each has this, until it is left out.
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
  /// How much better its bearings that fit tell its inverse distance than the prior does, with poses taken as known:
  /// the ratio of the information, as of the last evaluate().
  double told_beside_prior(LandmarkId id) const;
  /// Else it is none: no bearing is of it.
  bool is_unknown(LandmarkId id) const { return landmarks_[id].known || !landmarks_[id].bearings.empty(); }
  const Remembered& remembered() const { return *remembered_; }
  const OdometryMeasurement& odometry_to(PoseId id) const { return odometry_[id]; }  ///< from the pose before
  const BearingMeasurement& bearing(BearingId id) const { return bearings_[id]; }
  BearingId first_bearing_of(PoseId id) const {
    return id < poses_.size() ? poses_[id].first_bearing : bearings_.size();
  }
  LandmarkId landmark_of(BearingId id) const { return links_[id].landmark; }
  /// Squared, in standard deviations, as of the last evaluate(); 0 when it is of no landmark.
  double chi2_of(BearingId id) const;
  /// d(residual) / d(alpha, rho) of its landmark, in standard deviations, as of the last evaluate().
  const Eigen::Vector2d& by_landmark_of(BearingId id) const { return links_[id].by_landmark; }
  double odometry_chi2(PoseId id) const { return 2.0 * poses_[id].energy; }  ///< likewise, of odometry_to()
  const Calibration& calibration() const { return calibration_; }

  Block block_of_pose(PoseId id) const { return poses_[id].block; }
  Block block_of_landmark(LandmarkId id) const { return landmarks_[id].block; }
  static constexpr Block kCalibrationBlock = 0;
  Block blocks() const { return blocks_.size(); }

  /// Makes residuals and derivatives those of the moment, where something has changed, and sums them up.
  void evaluate();
  double energy() const { return energy_; }
  /// Half the squared residuals, of each bearing at most `most`, and the priors': whatever the kernel, as of the last
  /// evaluate().
  double bounded_energy(double most) const;
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
    Calibration calibration = Calibration::Zero();
  };
  Values values() const;
  /// What a step has moved, as it was before.
  struct Moved {
    std::vector<std::pair<PoseId, SmoothedPose>> poses;
    struct Landmark {
      LandmarkId id;
      SmoothedLandmark state;
      double prior_mean_per_m;
    };
    std::vector<Landmark> landmarks;
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
  enum class Kind : std::uint8_t { calibration, pose, landmark };
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
    std::vector<BearingId> bearings;
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

  Block add_block(Kind kind, std::int32_t id, int size);
  void keep_pose(const BearingGraph& before, PoseId id, const std::optional<OdometryMeasurement>& way,
                 std::vector<BearingId>& bearing_now);
  void keep_remembered(const std::vector<PoseId>& pose_now);
  void list_remembered_blocks();
  BearingId end_of_bearings(PoseId pose) const { return first_bearing_of(pose + 1); }
  bool calibrates(int which) const { return calibration_row_[static_cast<std::size_t>(which)] >= 0; }
  bool calibrates_odometry() const;

  void move_landmark(LandmarkEntry& landmark, const Eigen::Vector2d& by, const Eigen::VectorXd& step) const;
  void evaluate_odometry(PoseId pose);
  void evaluate_bearing(BearingId bearing);
  bool is_stale(const PoseEntry& pose, const OdometryMeasurement& measured) const;
  bool is_stale(const Link& link, const BearingMeasurement& measured) const;
  void sum_odometry(PoseId pose);
  void sum_bearing(const Link& link, const PoseEntry& pose);
  void sum_priors();
  void sum_remembered();
  bool is_remembered(Block block) const;

  void add_pose_terms(PoseId pose, FrontMatrix& front);
  void add_landmark_terms(LandmarkId landmark, FrontMatrix& front);
  void add_calibration_terms(FrontMatrix& front) const;
  void append_remembered(Block block, std::vector<Block>& out) const;
  void add_remembered(Block block, FrontMatrix& front) const;
  void add_odometry(PoseId pose, FrontMatrix& front);
  void add_bearing(BearingId bearing, FrontMatrix& front);
  bool comes_later(const FrontMatrix& front, Block block, int row) const;

  SmootherSettings settings_;
  std::array<int, kCalibrations> calibration_row_{};  // -1: no unknown
  std::array<double, kCalibrations> calibration_sigma_{};
  int calibration_size_ = 0;
  Calibration calibration_ = Calibration::Zero();
  bool calibration_moved_ = true;

  SharedPages<BlockEntry> blocks_;
  SharedPages<PoseEntry> poses_;
  SharedPages<OdometryMeasurement> odometry_;  // one for each pose
  SharedPages<BearingMeasurement> bearings_;
  SharedPages<Link> links_;  // one for each bearing
  SharedPages<LandmarkEntry, 8> landmarks_;
  std::shared_ptr<const Remembered> remembered_ = std::make_shared<Remembered>();
  std::vector<Block> remembered_blocks_;  // of its entries, in their order
  int rows_ = 0;
  double energy_ = 0.0;
  Eigen::VectorXd gradient_;
  std::vector<std::pair<Block, Block>> stale_;
};

}  // namespace azimuth
