#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "slam/ekf/batch_update.hpp"
#include "slam/ekf/block_triangle.hpp"
#include "slam/ekf/considered.hpp"
#include "slam/ekf/observation_row.hpp"
#include "slam/geometry/index.hpp"
#include "slam/geometry/motion.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// What is one landmark is not at one place to the last bit: variance along each axis.
inline constexpr double kSamePlace_m2 = 1e-4;

/// What the entries of a block are. Blocks of things in the world start with a position in
/// the map frame.
enum class BlockKind : std::uint8_t {
  pose,            ///< x, y, heading: the robot, or a clone of it (SPEC I.4)
  point,           ///< x, y: a landmark
  inverse_depth,   ///< x, y of the first sighting, absolute bearing, inverse distance [1/m]
  scalar,          ///< one angle, such as the camera's yaw offset
  plain_pair,      ///< two numbers that no turn of the map changes, such as the centre of an image
  inverse_height,  ///< x, y of the first sighting, offset per metre of height (x, y), inverse height [1/m]
  point3           ///< x, y, z: a landmark in space
};
constexpr Index size_of(BlockKind kind) {
  constexpr std::array<Index, 7> kSizes{3, 2, 4, 1, 2, 5, 3};
  return kSizes[as_size(kind)];
}

/// The mean and joint covariance of everything a filter estimates: the robot's pose first, then blocks that come and
/// go (SPEC I.1; the order of blocks is free here).
///
/// Nothing allocates unless the state grows beyond its largest size so far.
///
/// Thread contract: thread-bound.
class JointState {
 public:
  /// How a correction is applied to the mean, and what it does to the covariance.
  enum class Retraction : std::uint8_t {
    additive,  ///< the textbook EKF (SPEC I.7)
    /// A heading correction turns all positions with it (right-invariant error). An unobservable turn of the whole
    /// map then stays unobservable whatever the estimate, which the textbook filter forgets: it gains heading
    /// information from nothing and grows overconfident.
    invariant
  };

  /// Starts with the robot's pose at offset 0.
  explicit JointState(const Pose2& T_map_body = {}, const Eigen::Matrix3d& covariance = Eigen::Matrix3d::Zero());

  static constexpr Index kPose = 0, kHeading = kPose + 2, kNoEntry = -1;
  /// One beyond the last entry in use; gaps count.
  Index extent() const { return P_.extent(); }
  double mean(Index entry) const { return mean_(entry); }
  bool is_position(Index entry) const { return entries_[as_size(entry)] == Entry::x; }
  Eigen::Vector2d position(Index block) const { return {mean_(block), mean_(block + 1)}; }
  Pose2 pose(Index block = kPose) const { return {mean_(block), mean_(block + 1), mean_(block + 2)}; }
  double covariance(Index row, Index column) const { return P_(row, column); }
  /// Of the entries from `row` on with those from `column` on.
  template <int Size>
  Eigen::Matrix<double, Size, Size> block_covariance(Index row, Index column) const {
    Eigen::Matrix<double, Size, Size> P;
    for (Index c = 0; c < Size; ++c)
      for (Index r = 0; r < Size; ++r) P(r, c) = covariance(row + r, column + c);
    return P;
  }
  /// The covariance between `rows` and `columns`, lists of entries.
  void covariance(std::span<const Index> rows, std::span<const Index> columns, Eigen::Ref<Eigen::MatrixXd> out) const;
  /// The joint covariance of `entries`, which ascend.
  void covariance(std::span<const Index> entries, PackedSymmetric& out) const;
  Eigen::Matrix3d pose_covariance(Index block = kPose) const { return block_covariance<3>(block, block); }
  /// H_a P H_b^T: the covariance of what two rows measure, without its noise.
  double covariance(const ObservationRow& a, const ObservationRow& b) const { return P_.between(a, b); }
  Eigen::Matrix2d covariance(const RowPair& a, const RowPair& b) const { return P_.between(a, b); }
  Eigen::Matrix2d position_covariance(Index block) const { return block_covariance<2>(block, block); }

  /// Eq 15 to 18 of SPEC I.3: the robot moves to `T_map_body`, P <- G P G^T + noise.
  void move_robot(const Pose2& T_map_body, const Eigen::Matrix3d& G, const Eigen::Matrix3d& noise);

  /// What an entry owes to errors of the constants that motion depends on.
  static constexpr int kConsidered = considered::kCount;
  using ByConsidered = Eigen::Matrix<double, 3, kConsidered>;
  using ConsideredRow = Eigen::Matrix<double, 1, kConsidered>;
  /// The constants are off by what has these variances; 0: exact. They are considered, not estimated: gains are those
  /// of a filter that takes them for exact, and what their errors have made of each entry by now, d(entry) / d(error),
  /// is carried along: by motion as D_v <- G D_v + B, by an update as D <- (I - K H) D, by a new block as D_new = J
  /// D_sources. What is uncertain by them comes on top of the covariance, D diag(variances) D^T (the consider
  /// covariance: Tapley, Schutz, Born, "Statistical orbit determination", 2004, ch. 6).
  void consider(const Considered& variances) { considered_ = variances; }
  const Considered& considered() const { return considered_; }
  /// A row of D.
  ConsideredRow by_considered(Index entry) const { return D_.row(entry); }
  void set_by_considered(Index entry, const ConsideredRow& row) { D_.row(entry) = row; }
  /// Allows for so much of each error from now on: the mean moves by D times what is new of it.
  void believe(const Considered& errors, Retraction retraction);
  const Considered& believed() const { return believed_; }
  /// What innovations have told of the errors so far: with D they are nu = H D (error - believed) + noise of
  /// covariance S, of which the second part is made up for.
  struct Told {
    Eigen::Matrix<double, kConsidered, kConsidered> information =
        Eigen::Matrix<double, kConsidered, kConsidered>::Zero();  ///< D^T H^T S^-1 H D
    Considered pull = Considered::Zero();                         ///< D^T H^T S^-1 (nu + H D believed)
  };
  const Told& told_of_considered() const { return told_; }
  /// The same as above, B being d(pose') / d(errors).
  void move_robot(const Pose2& T_map_body, const Eigen::Matrix3d& G, const Eigen::Matrix3d& noise,
                  const ByConsidered& B);

  /// Adds noise to the robot's pose where it stands.
  void inflate_robot(const Eigen::Matrix3d& noise);

  /// Forgets what was known of the robot's pose and makes it anew: a linear function of entries that are not the
  /// robot's, plus independent noise, as add() does for a block.
  void replace_robot(const Pose2& T_map_body, std::span<const Index> sources, const Eigen::Matrix3Xd& jacobian,
                     const Eigen::Matrix3d& noise);

  /// A copy of the robot's pose, fully correlated with it (SPEC I.4, eq 21).
  Index clone_robot();

  /// A new block with the given mean, a linear function of existing entries plus independent noise:
  /// P_new,* = J P_sources,*, P_new = J P J^T + noise (SPEC I.8). `mean` has size_of(kind) entries, `jacobian` a column
  /// for each source.
  Index add(BlockKind kind, const Eigen::Ref<const Eigen::VectorXd>& mean, std::span<const Index> sources,
            const Eigen::Ref<const Eigen::MatrixXd>& jacobian, const Eigen::Ref<const Eigen::MatrixXd>& noise);

  /// A new block of which nothing is known but the mean; set_covariance() is to follow.
  Index add(BlockKind kind, const Eigen::Ref<const Eigen::VectorXd>& mean);
  /// Replaces the joint covariance of `entries`, which ascend, by what was known of them elsewhere. Rows and columns
  /// for which the entry is kNoEntry are left out.
  void set_covariance(std::span<const Index> entries, const PackedSymmetric& covariance);
  void set_mean(Index entry, double value) { mean_(entry) = value; }

  /// From now on no update corrects the entries from `first` on, mean or covariance, whatever it says of them: they are
  /// considered with their uncertainty (Schmidt, "Application of state-space methods to navigation problems", 1966).
  /// Corrections are additive then, since what is held cannot turn along. Nothing may be added any more.
  void hold_from(Index first) { held_from_ = first; }
  Index held_from() const { return held_from_; }
  bool holds() const { return held_from_ < extent(); }

  /// Marginalises a block out.
  void remove(Index block, BlockKind kind);

  /// Replaces an inverse-depth block by the point it describes; the point keeps the block's offset.
  void promote(Index block, const Eigen::Vector2d& position, const Eigen::Matrix<double, 2, 4>& jacobian);
  /// Likewise an inverse-height block.
  void promote(Index block, const Eigen::Vector3d& position, const Eigen::Matrix<double, 3, 5>& jacobian);

  /// One batch update with all rows (SPEC I.7, eq 16 to 18): gain, then one symmetric rank-k update of the triangle.
  /// False, with nothing changed, when the innovation covariance is not positive definite.
  bool update(std::span<const ObservationRow> rows, Retraction retraction);

  /// Likewise, but only the block is corrected: the rest is considered with its uncertainty (Schmidt), whatever the
  /// rows say of it. Its corrections are additive.
  bool update_only(Index block, BlockKind kind, std::span<const ObservationRow> rows);

 private:
  // x and y: two numbers that turn with the map, be they a place or a direction in it.
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
  std::vector<Entry> entries_;  // what each entry is
  Index held_from_ = std::numeric_limits<Index>::max();
  Considered considered_ = Considered::Zero();  // variances
  Considered believed_ = Considered::Zero();
  Eigen::Matrix<double, Eigen::Dynamic, kConsidered> D_;  // d(entry) / d(errors of what is considered)
  Told told_;

  // Workspace of update().
  BatchUpdate batch_;
  Eigen::VectorXd correction_, shear_;
  Eigen::Matrix<double, Eigen::Dynamic, kConsidered> whitened_HD_;
};

}  // namespace azimuth
