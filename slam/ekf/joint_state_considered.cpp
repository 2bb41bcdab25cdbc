// JointState: what is considered, not estimated: constants, and all but one block of the state.

#include <algorithm>

#include "slam/ekf/joint_state.hpp"

namespace azimuth {
void JointState::move_robot(const Pose2& T_map_body, const Eigen::Matrix3d& G, const Eigen::Matrix3d& noise,
                            const ByScales& B) {
  D_.topRows<3>() = (G * D_.topRows<3>() + B).eval();
  move_robot(T_map_body, G, noise);
}

/// L^-1 H D.
void JointState::whiten_considered(std::span<const ObservationRow> rows) {
  for (Index r = 0; r < static_cast<Index>(rows.size()); ++r) {
    const ObservationRow& row = rows[static_cast<std::size_t>(r)];
    Eigen::RowVector2d HD = Eigen::RowVector2d::Zero();
    for (std::size_t p = 0; p < static_cast<std::size_t>(row.count); ++p)
      for (Index i = 0; i < row.parts[p].size; ++i)
        HD += row.parts[p].coefficients[static_cast<std::size_t>(i)] * D_.row(row.parts[p].offset + i);
    for (Index k = 0; k < r; ++k) HD -= S_(r, k) * whitened_HD_.row(k);
    whitened_HD_.row(r) = HD / S_(r, r);
  }
}

/* D <- D - K H D = D - W L^-1 H D, W being whitened by now. What is held takes no gain. The invariant error's
 * coordinates move with the mean as those of the covariance do, by T = I + u e_heading^T. */
void JointState::correct_considered(std::span<const ObservationRow> rows, Retraction retraction) {
  if (considered_.isZero(0.0)) return;
  whiten_considered(rows);
  const Index count = static_cast<Index>(rows.size());
  const Index free = std::min(extent_, held_from_);
  for (Index c = 0; c < 2; ++c)
    for (Index k = 0; k < count; ++k) D_.col(c).head(free) -= whitened_HD_(k, c) * W(k).head(free);
  if (retraction != Retraction::invariant) return;
  const Eigen::RowVector2d by_heading = D_.row(kHeading);
  for (Index c = 0; c < 2; ++c) D_.col(c).head(extent_) += by_heading(c) * shear_.head(extent_);
}

/* With the gain (K_b, 0) the joint covariance loses W_b W^T in the block's rows and columns, and nothing elsewhere. */
bool JointState::update_only(Index block, BlockKind kind, std::span<const ObservationRow> rows) {
  const Index count = static_cast<Index>(rows.size());
  if (S_.rows() < count) reserve_rows(2 * count);
  compute_gain(rows);
  if (!whiten(rows)) return false;
  whiten_considered(rows);
  const Index end = block + size_of(kind);
  for (Index i = block; i < end; ++i) {
    for (Index j = 0; j < extent_; ++j) {
      if (j >= block && j < i) continue;  // both entries are the block's: once
      for (Index k = 0; k < count; ++k) element(i, j) -= W(k)(i) * W(k)(j);
    }
    for (Index k = 0; k < count; ++k) D_.row(i) -= W(k)(i) * whitened_HD_.row(k);
    correct_entry(i, count);
  }
  return true;
}

}  // namespace azimuth
