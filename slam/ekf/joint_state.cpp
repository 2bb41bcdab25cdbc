#include "slam/ekf/joint_state.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "slam/ekf/invariant_motion.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

// Below this heading variance the shear of the covariance is negligible.
constexpr double kCertainHeading_rad2 = 1e-18;

}  // namespace

JointState::JointState(const Pose2& T_map_body, const Eigen::Matrix3d& covariance) {
  const Index pose = allocate(BlockKind::pose);
  assert(pose == kPose);
  mean_.segment<3>(pose) = T_map_body.vector();
  for (Index c = 0; c < 3; ++c)
    for (Index r = c; r < 3; ++r) P_.element(r, c) = covariance(r, c);
}

void JointState::covariance(std::span<const Index> rows, std::span<const Index> columns,
                            Eigen::Ref<Eigen::MatrixXd> out) const {
  for (std::size_t c = 0; c < columns.size(); ++c)
    for (std::size_t r = 0; r < rows.size(); ++r) out(as_index(r), as_index(c)) = covariance(rows[r], columns[c]);
}

void JointState::covariance(std::span<const Index> entries, PackedSymmetric& out) const {
  out.resize(entries.size());
  for (std::size_t c = 0; c < entries.size(); ++c) {
    const double* column = P_.column(entries[c]);
    double* into = out.below(c).data();
    for (std::size_t r = c; r < entries.size(); ++r) *into++ = column[entries[r]];
  }
}

Index JointState::add(BlockKind kind, const Eigen::Ref<const Eigen::VectorXd>& mean) {
  const Index size = size_of(kind);
  return add(kind, mean, {}, Eigen::MatrixXd(size, 0), Eigen::MatrixXd::Zero(size, size));
}

void JointState::set_covariance(std::span<const Index> entries, const PackedSymmetric& covariance) {
  assert(covariance.size() == entries.size());
  for (std::size_t c = 0; c < entries.size(); ++c) {
    if (entries[c] == kNoEntry) continue;
    const double* from = covariance.below(c).data();
    for (std::size_t r = c; r < entries.size(); ++r, ++from)
      if (entries[r] != kNoEntry) P_.element(entries[r], entries[c]) = *from;
  }
}

void JointState::move_robot(const Pose2& T_map_body, const Eigen::Matrix3d& G, const Eigen::Matrix3d& noise) {
  static_assert(kPose == 0, "the robot's columns lie wholly below the diagonal block");
  const Eigen::Matrix3d P = G * pose_covariance() * G.transpose() + noise;
  for (Index c = 0; c < 3; ++c)
    for (Index r = c; r < 3; ++r) P_.element(r, c) = P(r, c);
  for (Index i = 3; i < extent(); ++i) {  // P_vm <- G P_vm
    const Eigen::Vector3d column = G * Eigen::Vector3d(P_(i, 0), P_(i, 1), P_(i, 2));
    for (Index c = 0; c < 3; ++c) P_.element(i, c) = column(c);
  }
  mean_.segment<3>(kPose) = T_map_body.vector();
}

void JointState::inflate_robot(const Eigen::Matrix3d& noise) {
  for (Index c = 0; c < 3; ++c)
    for (Index r = c; r < 3; ++r) P_.element(r, c) += noise(r, c);
}

void JointState::replace_robot(const Pose2& T_map_body, std::span<const Index> sources,
                               const Eigen::Matrix3Xd& jacobian, const Eigen::Matrix3d& noise) {
  assert(jacobian.cols() == as_index(sources.size()));
  // P_vm = J P_sources,m, then P_vv = J P_sources,v + noise. No source is one of the entries that are written.
  const auto combine = [&](Index r, Index column) {
    double sum = 0.0;
    for (std::size_t s = 0; s < sources.size(); ++s) sum += jacobian(r, as_index(s)) * covariance(sources[s], column);
    return sum;
  };
  D_.topRows<3>().setZero();
  for (std::size_t s = 0; s < sources.size(); ++s) D_.topRows<3>() += jacobian.col(as_index(s)) * D_.row(sources[s]);
  for (Index i = 3; i < extent(); ++i)
    for (Index r = 0; r < 3; ++r) P_.element(i, r) = combine(r, i);
  for (Index c = 0; c < 3; ++c)
    for (Index r = c; r < 3; ++r) P_.element(r, c) = combine(r, c) + noise(r, c);
  mean_.segment<3>(kPose) = T_map_body.vector();
}

Index JointState::clone_robot() {
  const Index clone = allocate(BlockKind::pose);
  for (Index c = 0; c < 3; ++c) {
    for (Index i = 0; i < extent(); ++i)
      if (i < clone || i >= clone + 3) P_.element(clone + c, i) = covariance(kPose + c, i);
    mean_(clone + c) = mean_(kPose + c);
    D_.row(clone + c) = D_.row(kPose + c);
  }
  for (Index c = 0; c < 3; ++c)
    for (Index r = c; r < 3; ++r) P_.element(clone + r, clone + c) = covariance(kPose + r, kPose + c);
  return clone;
}

Index JointState::add(BlockKind kind, const Eigen::Ref<const Eigen::VectorXd>& mean, std::span<const Index> sources,
                      const Eigen::Ref<const Eigen::MatrixXd>& jacobian,
                      const Eigen::Ref<const Eigen::MatrixXd>& noise) {
  const Index size = size_of(kind);
  assert(mean.size() == size && jacobian.rows() == size && noise.rows() == size && noise.cols() == size);
  assert(jacobian.cols() == as_index(sources.size()));
  const Index block = allocate(kind);
  // P_new,* = J P_sources,* for all existing entries (the new entries are still zero).
  for (Index i = 0; i < extent(); ++i) {
    if (i >= block && i < block + size) continue;
    for (Index r = 0; r < size; ++r) {
      double sum = 0.0;
      for (Index s = 0; s < jacobian.cols(); ++s) sum += jacobian(r, s) * covariance(sources[as_size(s)], i);
      P_.element(block + r, i) = sum;
    }
  }
  for (Index c = 0; c < size; ++c)
    for (Index r = c; r < size; ++r) {
      double sum = noise(r, c);
      for (Index s = 0; s < jacobian.cols(); ++s) sum += covariance(block + r, sources[as_size(s)]) * jacobian(c, s);
      P_.element(block + r, block + c) = sum;
    }
  mean_.segment(block, size) = mean;
  for (Index s = 0; s < jacobian.cols(); ++s)
    for (Index r = 0; r < size; ++r) D_.row(block + r) += jacobian(r, s) * D_.row(sources[as_size(s)]);
  return block;
}

void JointState::remove(Index block, BlockKind kind) { release(block, size_of(kind)); }

void JointState::promote(Index block, const Eigen::Vector2d& position, const Eigen::Matrix<double, 2, 4>& jacobian) {
  replace_by_fewer<2, 4>(block, position, jacobian);
}

void JointState::promote(Index block, const Eigen::Vector3d& position, const Eigen::Matrix<double, 3, 5>& jacobian) {
  replace_by_fewer<3, 5>(block, position, jacobian);
  entries_[as_size(block + 2)] = Entry::plain;
}

/// P <- J P J^T for the block's entries; the last ones become a gap.
template <int New, int Old>
void JointState::replace_by_fewer(Index block, const Eigen::Matrix<double, New, 1>& mean,
                                  const Eigen::Matrix<double, New, Old>& jacobian) {
  const Eigen::Matrix<double, Old, Old> old = block_covariance<Old>(block, block);
  for (Index i = 0; i < extent(); ++i) {
    if (i >= block && i < block + Old) continue;
    Eigen::Matrix<double, Old, 1> column;
    for (Index r = 0; r < Old; ++r) column(r) = covariance(block + r, i);
    const Eigen::Matrix<double, New, 1> promoted = jacobian * column;
    for (Index r = 0; r < New; ++r) P_.element(block + r, i) = promoted(r);
  }
  const Eigen::Matrix<double, New, New> P = jacobian * old * jacobian.transpose();
  for (Index c = 0; c < New; ++c)
    for (Index r = c; r < New; ++r) P_.element(block + r, block + c) = P(r, c);
  mean_.segment<New>(block) = mean;
  const Eigen::Matrix<double, Old, kConsidered> D_old = D_.template middleRows<Old>(block);
  D_.template middleRows<New>(block) = jacobian * D_old;
  release(block + New, Old - New);
}

bool JointState::update(std::span<const ObservationRow> rows, Retraction retraction) {
  if (rows.empty()) return true;
  const Index count = as_index(rows.size());
  if (!batch_.compute(P_, rows)) return false;
  if (holds()) {
    correct_free(count);
    correct_considered(rows, Retraction::additive);
    return true;
  }
  correct_mean(count, retraction);
  correct_considered(rows, retraction);
  const bool is_sheared = retraction == Retraction::invariant && append_shear(count);
  batch_.subtract_from(P_, count, is_sheared ? 1 : 0);
  return true;
}

/// x <- x + K nu. Writes the displacement of each position, turned by a right angle, into shear_, as apply_correction()
/// does.
void JointState::correct_mean(Index rows, Retraction retraction) {
  auto correction = correction_.head(extent());
  correction.setZero();
  batch_.add_correction(rows, correction.data());
  apply_correction(retraction);
}

void JointState::apply_correction(Retraction retraction) {
  const auto correction = correction_.head(extent());
  const double turn_rad = correction(kHeading);
  const InvariantMotion turn(turn_rad);
  shear_.head(extent()).setZero();
  for (Index i = 0; i < extent(); ++i) {
    if (entries_[as_size(i)] == Entry::angle) {
      mean_(i) = wrap(mean_(i) + correction(i));
    } else if (entries_[as_size(i)] == Entry::x) {
      const Eigen::Vector2d q = mean_.segment<2>(i), dq = correction.segment<2>(i);
      if (retraction == Retraction::invariant) {
        mean_.segment<2>(i) = turn.apply(q, dq);
        shear_.segment<2>(i) = perpendicular(mean_.segment<2>(i) - q);
      } else {
        mean_.segment<2>(i) = q + dq;
      }
    } else if (entries_[as_size(i)] == Entry::plain) {
      mean_(i) += correction(i);
    }
  }
}

/// Held entries (h) take no gain, free ones (f) do: x_f <- x_f + K_f nu, P_ff <- P_ff - W_f W_f^T, P_hf <- P_hf - W_h
/// W_f^T; P_hh stays.
void JointState::correct_free(Index rows) {
  for (Index c = 0; c < held_from_; ++c) {
    Eigen::Map<Eigen::VectorXd> column(P_.column(c) + c, extent() - c);
    for (Index k = 0; k < rows; ++k) column.noalias() -= batch_.W(k)(c) * batch_.W(k).tail(extent() - c);
    correct_entry(c, rows);
  }
}

void JointState::correct_entry(Index entry, Index rows) {
  for (Index k = 0; k < rows; ++k) mean_(entry) += batch_.whitened_innovation(k) * batch_.W(k)(entry);
  if (entries_[as_size(entry)] == Entry::angle) mean_(entry) = wrap(mean_(entry));
}

/// The covariance is stored in coordinates (position, heading) at the present mean. Moving the mean leaves the
/// invariant error unchanged, so these coordinates change: P <- T P T^T with T = I + u e_heading^T and u = (q+ -
/// q)_perp, that is P += u v^T + v u^T with v = P e_heading + u P_heading / 2, where P is the covariance after the
/// update.
bool JointState::append_shear(Index count) {
  auto v = batch_.W(count + 1);
  for (Index i = 0; i < extent(); ++i) v(i) = covariance(i, kHeading);
  batch_.subtract_products_with(kHeading, count, v.data());
  if (!(v(kHeading) > kCertainHeading_rad2)) return false;
  const auto u = shear_.head(extent());
  v = -(v + 0.5 * v(kHeading) * u);  // negative, since the product is subtracted
  batch_.W(count) = u;
  return true;
}

Index JointState::allocate(BlockKind kind) {
  assert(!holds());
  const Index block = P_.allocate(size_of(kind));
  fit_to_storage();
  using Tags = std::array<Entry, BlockTriangle::kLargestBlock>;  // shorter blocks end with gaps
  static constexpr std::array<Tags, 7> kTags{{{Entry::x, Entry::y, Entry::angle},
                                              {Entry::x, Entry::y},
                                              {Entry::x, Entry::y, Entry::angle, Entry::plain},
                                              {Entry::angle},
                                              {Entry::plain, Entry::plain},
                                              {Entry::x, Entry::y, Entry::x, Entry::y, Entry::plain},
                                              {Entry::x, Entry::y, Entry::plain}}};
  for (Index i = 0; i < size_of(kind); ++i) entries_[as_size(block + i)] = kTags[as_size(kind)][as_size(i)];
  return block;
}

void JointState::fit_to_storage() {
  const Index capacity = P_.capacity();
  batch_.fit(P_);
  if (mean_.size() == capacity) return;
  mean_.conservativeResizeLike(Eigen::VectorXd::Zero(capacity));
  D_.conservativeResizeLike(decltype(D_)::Zero(capacity, kConsidered));
  entries_.resize(as_size(capacity), Entry::gap);
  correction_.resize(capacity);
  shear_.resize(capacity);
}

void JointState::release(Index first, Index count) {
  P_.release(first, count);
  for (Index i = first; i < first + count; ++i) {
    mean_(i) = 0.0;
    D_.row(i).setZero();
    entries_[as_size(i)] = Entry::gap;
  }
}

}  // namespace azimuth
