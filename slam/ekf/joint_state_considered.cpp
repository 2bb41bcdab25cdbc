// JointState: considered quantities that are not estimated: constants, and all but one block of the state.

#include <algorithm>

#include "slam/ekf/joint_state.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {

void JointState::move_robot(const Pose2& T_map_body, const Eigen::Matrix3d& G, const Eigen::Matrix3d& noise,
                            const ByConsidered& B) {
  D_.topRows<3>() = (G * D_.topRows<3>() + B).eval();
  move_robot(T_map_body, G, noise);
}

/// Computes L^-1 H D into whitened_HD_.
void JointState::whiten_considered(std::span<const ObservationRow> rows) {
  if (whitened_HD_.rows() < batch_.most_rows()) whitened_HD_.resize(batch_.most_rows(), kConsidered);
  for (Index r = 0; r < as_index(rows.size()); ++r) {
    const ObservationRow& row = rows[as_size(r)];
    ConsideredRow HD = ConsideredRow::Zero();
    for (std::size_t p = 0; p < as_size(row.count); ++p)
      for (Index i = 0; i < row.parts[p].size; ++i)
        HD += row.parts[p].coefficients[as_size(i)] * D_.row(row.parts[p].offset + i);
    for (Index k = 0; k < r; ++k) HD -= batch_.L(r, k) * whitened_HD_.row(k);
    whitened_HD_.row(r) = HD / batch_.L(r, r);
  }
}

/* D <- D - K H D = D - W L^-1 H D with the whitened W. Held entries take no gain. The coordinates of the invariant
 * error move with the mean as those of the covariance do, by T = I + u e_heading^T. */
void JointState::correct_considered(std::span<const ObservationRow> rows, Retraction retraction) {
  if (considered_.isZero(0.0)) return;
  whiten_considered(rows);
  const Index count = as_index(rows.size());
  for (Index k = 0; k < count; ++k) {
    told_.information += whitened_HD_.row(k).transpose() * whitened_HD_.row(k);
    const double whole_innovation = batch_.whitened_innovation(k) + whitened_HD_.row(k).dot(believed_);
    told_.pull += whitened_HD_.row(k).transpose() * whole_innovation;
  }
  const Index free = std::min(extent(), held_from_);
  for (Index c = 0; c < kConsidered; ++c)
    for (Index k = 0; k < count; ++k) D_.col(c).head(free) -= whitened_HD_(k, c) * batch_.W(k).head(free);
  if (retraction == Retraction::invariant) shear_considered();
}

void JointState::shear_considered() {
  const ConsideredRow by_heading = D_.row(kHeading);
  for (Index c = 0; c < kConsidered; ++c) D_.col(c).head(extent()) += by_heading(c) * shear_.head(extent());
}

/* The coordinates of P and D move with the mean as in an update; this is an update without rows. */
void JointState::believe(const Considered& errors, Retraction retraction) {
  correction_.head(extent()).noalias() = D_.topRows(extent()) * (errors - believed_);
  believed_ = errors;
  apply_correction(retraction);
  if (retraction != Retraction::invariant || !batch_.compute(P_, {})) return;
  shear_considered();
  if (append_shear(0)) batch_.subtract_from(P_, 0, 1);
}

/* With the gain (K_b, 0) the joint covariance decreases by W_b W^T in the block's rows and columns only. */
bool JointState::update_only(Index block, BlockKind kind, std::span<const ObservationRow> rows) {
  const Index count = as_index(rows.size());
  if (!batch_.compute(P_, rows)) return false;
  whiten_considered(rows);
  const Index end = block + size_of(kind);
  for (Index i = block; i < end; ++i) {
    for (Index j = 0; j < extent(); ++j) {
      if (j >= block && j < i) continue;  // both entries belong to the block: update once
      for (Index k = 0; k < count; ++k) P_.element(i, j) -= batch_.W(k)(i) * batch_.W(k)(j);
    }
    for (Index k = 0; k < count; ++k) D_.row(i) -= batch_.W(k)(i) * whitened_HD_.row(k);
    correct_entry(i, count);
  }
  return true;
}

}  // namespace azimuth
