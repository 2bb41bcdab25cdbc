#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "slam/ekf/batch_update.hpp"
#include "slam/ekf/block_triangle.hpp"
#include "slam/ekf/observation_row.hpp"
#include "slam/geometry/index.hpp"
#include "slam/geometry/motion.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/geometry/wrong_rig.hpp"
#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

// Constants of the rig that a filter considers instead of estimating: true value minus the rig's value.
namespace considered {
inline constexpr int scale_distance = 0, scale_turn = 1;  ///< Relative errors of the odometer's scales
inline constexpr int lag = 2;                             ///< Images are taken this much earlier than stamped [s]
inline constexpr int drift = 3;                           ///< Heading gained per metre driven [rad/m]
inline constexpr int yaw = 4;                             ///< The camera is turned this much farther to the left [rad]
inline constexpr int camera = 5;  ///< Two entries: the camera is this much farther ahead, and to the left [m]
inline constexpr int kCount = 7;
}  // namespace considered

/// One number for each constant: its error, variance or standard deviation.
using Considered = Eigen::Matrix<double, considered::kCount, 1>;

/// Two estimates of one landmark need not agree to the last bit: variance of their difference along each axis.
inline constexpr double kSamePlace_m2 = 1e-4;

/// Types of blocks. Blocks of things in the world start with a position in the map frame.
enum class BlockKind : std::uint8_t {
  pose,            ///< x, y, heading: the robot, or a clone of its pose (mathematics I.4)
  point,           ///< x, y: a landmark
  inverse_depth,   ///< x, y of the first observation, absolute bearing, inverse distance [1/m]
  scalar,          ///< One angle, such as the camera's yaw offset
  plain_pair,      ///< Two numbers that no turn of the map changes, such as the centre of an image
  inverse_height,  ///< x, y of the first observation, offset per metre of height (x, y), inverse height [1/m]
  point3           ///< x, y, z: a landmark in space
};
constexpr Index size_of(BlockKind kind) {
  constexpr std::array<Index, 7> kSizes{3, 2, 4, 1, 2, 5, 3};
  return kSizes[as_size(kind)];
}

/// The mean and joint covariance of everything that a filter estimates: the robot's pose first, then blocks that are
/// added and removed in any order (mathematics I.1).
///
/// Nothing allocates unless the state grows beyond its largest size so far.
///
/// Thread contract: thread-bound.
class JointState {
 public:
  /// How a correction is applied to the mean, and what it does to the covariance.
  enum class Retraction : std::uint8_t {
    additive,  ///< Textbook EKF (mathematics I.7)
    /// Right-invariant error: a heading correction turns all positions with it. A turn of the whole map then stays
    /// unobservable at every estimate. The textbook EKF loses this property: it gains spurious heading information and
    /// grows overconfident.
    invariant
  };

  /// Starts with the robot's pose at offset 0.
  explicit JointState(const Pose2& T_map_body = {}, const Eigen::Matrix3d& covariance = Eigen::Matrix3d::Zero());

  static constexpr Index kPose = 0, kHeading = kPose + 2, kNoEntry = -1;
  /// One beyond the last entry in use, gaps included.
  Index extent() const { return P_.extent(); }
  double mean(Index entry) const { return mean_(entry); }
  bool is_position(Index entry) const { return entries_[as_size(entry)] == Entry::x; }
  Eigen::Vector2d position(Index block) const { return {mean_(block), mean_(block + 1)}; }
  Pose2 pose(Index block = kPose) const { return {mean_(block), mean_(block + 1), mean_(block + 2)}; }
  double covariance(Index row, Index column) const { return P_(row, column); }
  /// Covariance of the `Size` entries from `row` on with those from `column` on.
  template <int Size>
  Eigen::Matrix<double, Size, Size> block_covariance(Index row, Index column) const {
    Eigen::Matrix<double, Size, Size> P;
    for (Index c = 0; c < Size; ++c)
      for (Index r = 0; r < Size; ++r) P(r, c) = covariance(row + r, column + c);
    return P;
  }
  /// The covariance between `rows` and `columns`, lists of entries.
  void covariance(std::span<const Index> rows, std::span<const Index> columns, Eigen::Ref<Eigen::MatrixXd> out) const;
  /// The joint covariance of `entries`, which must ascend.
  void covariance(std::span<const Index> entries, PackedSymmetric& out) const;
  Eigen::Matrix3d pose_covariance(Index block = kPose) const { return block_covariance<3>(block, block); }
  /// H_a P H_b^T: the covariance of the quantities that two rows measure, without measurement noise.
  double covariance(const ObservationRow& a, const ObservationRow& b) const { return P_.between(a, b); }
  Eigen::Matrix2d covariance(const RowPair& a, const RowPair& b) const { return P_.between(a, b); }
  Eigen::Matrix2d position_covariance(Index block) const { return block_covariance<2>(block, block); }

  /// Eq 15 to 18 of mathematics I.3: the robot moves to `T_map_body`, P <- G P G^T + noise.
  void move_robot(const Pose2& T_map_body, const Eigen::Matrix3d& G, const Eigen::Matrix3d& noise);

  /// Considered constants: errors of the rig that motion depends on.
  static constexpr int kConsidered = considered::kCount;
  using ByConsidered = Eigen::Matrix<double, 3, kConsidered>;
  using ConsideredRow = Eigen::Matrix<double, 1, kConsidered>;
  /// Sets the variances of the errors; 0: exact. The errors are considered, not estimated: gains are those of a filter
  /// that takes the constants for exact, while the effect of the errors on each entry, D = d(entry) / d(error), is
  /// carried along: by motion as D_v <- G D_v + B, by an update as D <- (I - K H) D, for a new block as D_new = J
  /// D_sources. The errors add D diag(variances) D^T to the covariance (the consider covariance: Tapley, Schutz, Born,
  /// "Statistical orbit determination", 2004, ch. 6).
  void consider(const Considered& variances) { considered_ = variances; }
  const Considered& considered() const { return considered_; }
  /// A row of D.
  ConsideredRow by_considered(Index entry) const { return D_.row(entry); }
  void set_by_considered(Index entry, const ConsideredRow& row) { D_.row(entry) = row; }
  /// Corrects for these errors from now on: the mean moves by D times the change of `errors`.
  void believe(const Considered& errors, Retraction retraction);
  const Considered& believed() const { return believed_; }
  /// Information on the errors from the innovations so far. The innovations are nu = H D (error - believed) + noise of
  /// covariance S; adding H D believed makes them independent of `believed`.
  /// The information is D^T H^T S^-1 H D, the pull D^T H^T S^-1 (nu + H D believed).
  using Told = RigEvidence<kConsidered>;
  const Told& told_of_considered() const { return told_; }
  /// Moves the robot like move_robot() without B, and carries D along, with the derivative B = d(pose') / d(errors) of
  /// the motion.
  void move_robot(const Pose2& T_map_body, const Eigen::Matrix3d& G, const Eigen::Matrix3d& noise,
                  const ByConsidered& B);

  /// Adds noise to the robot's pose without moving it.
  void inflate_robot(const Eigen::Matrix3d& noise);

  /// Replaces the robot's pose by a linear function of entries that are not the robot's, plus independent noise, as
  /// add() does for a block. What was known of the pose is lost.
  void replace_robot(const Pose2& T_map_body, std::span<const Index> sources, const Eigen::Matrix3Xd& jacobian,
                     const Eigen::Matrix3d& noise);

  /// Adds a copy of the robot's pose, fully correlated with it (mathematics I.4, eq 21).
  Index clone_robot();

  /// Adds a block whose value is a linear function of existing entries plus independent noise: P_new,* = J P_sources,*,
  /// P_new = J P J^T + noise (mathematics I.8). `mean` has size_of(kind) entries, `jacobian` one column per source.
  Index add(BlockKind kind, const Eigen::Ref<const Eigen::VectorXd>& mean, std::span<const Index> sources,
            const Eigen::Ref<const Eigen::MatrixXd>& jacobian, const Eigen::Ref<const Eigen::MatrixXd>& noise);

  /// Adds a block with this mean and zero covariance; set_covariance() must follow.
  Index add(BlockKind kind, const Eigen::Ref<const Eigen::VectorXd>& mean);
  /// Replaces the joint covariance of `entries`, which must ascend. Rows and columns whose entry is kNoEntry are
  /// skipped.
  void set_covariance(std::span<const Index> entries, const PackedSymmetric& covariance);
  void set_mean(Index entry, double value) { mean_(entry) = value; }

  /// From now on no update corrects mean or covariance of the entries from `first` on: they are considered with their
  /// uncertainty (Schmidt, "Application of state-space methods to navigation problems", 1966). Corrections are then
  /// additive, since held entries cannot turn along. No block may be added any more.
  void hold_from(Index first) { held_from_ = first; }
  Index held_from() const { return held_from_; }
  bool holds() const { return held_from_ < extent(); }

  /// Marginalises a block out.
  void remove(Index block, BlockKind kind);

  /// Replaces an inverse-depth block by the point it describes; the point keeps the block's offset.
  void promote(Index block, const Eigen::Vector2d& position, const Eigen::Matrix<double, 2, 4>& jacobian);
  /// Replaces an inverse-height block by the point it describes; the point keeps the block's offset.
  void promote(Index block, const Eigen::Vector3d& position, const Eigen::Matrix<double, 3, 5>& jacobian);

  /// One batch update with all rows (mathematics I.7, eq 16 to 18): gain, then one symmetric rank-k update of the
  /// triangle. Returns false, with nothing changed, when the innovation covariance is not positive definite.
  bool update(std::span<const ObservationRow> rows, Retraction retraction);

  /// Batch update that corrects only the block, additively. All other entries are considered with their uncertainty
  /// (Schmidt).
  bool update_only(Index block, BlockKind kind, std::span<const ObservationRow> rows);

 private:
  // x and y: components of a position or a direction, which turn with the map.
  enum class Entry : std::uint8_t { gap, x, y, angle, plain };

  Index allocate(BlockKind kind);
  void fit_to_storage();
  template <int New, int Old>
  void replace_by_fewer(Index block, const Eigen::Matrix<double, New, 1>& mean,
                        const Eigen::Matrix<double, New, Old>& jacobian);
  void release(Index first, Index count);
  void correct_mean(Index rows, Retraction retraction);
  void apply_correction(Retraction retraction);
  bool append_shear(Index rows);
  void correct_free(Index rows);
  void correct_entry(Index entry, Index rows);
  void correct_considered(std::span<const ObservationRow> rows, Retraction retraction);
  void whiten_considered(std::span<const ObservationRow> rows);
  void shear_considered();

  BlockTriangle P_;
  Eigen::VectorXd mean_;
  std::vector<Entry> entries_;  // type of each entry
  Index held_from_ = std::numeric_limits<Index>::max();
  Considered considered_ = Considered::Zero();  // variances of the errors
  Considered believed_ = Considered::Zero();
  Eigen::Matrix<double, Eigen::Dynamic, kConsidered> D_;  // d(entry) / d(considered errors)
  Told told_;

  // Workspace of update().
  BatchUpdate batch_;
  Eigen::VectorXd correction_, shear_;
  Eigen::Matrix<double, Eigen::Dynamic, kConsidered> whitened_HD_;
};

}  // namespace azimuth
