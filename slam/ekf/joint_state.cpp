#include "slam/ekf/joint_state.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "slam/ekf/invariant_motion.hpp"
#include "slam/ekf/rank_update.hpp"

namespace azimuth {
namespace {

constexpr Index kFirstCapacity = 64;
constexpr Index kFirstRows = 16;
constexpr Index kShearColumns = 2;
// Keeps columns from starting a power of two apart, where they would share cache sets; a whole tile of the rank update.
constexpr Index kPadding = LowerTriangle::kTile;
static_assert(kFirstCapacity % LowerTriangle::kTile == 0);
// Below this heading variance there is no heading uncertainty whose direction could be wrong.
constexpr double kCertainHeading_rad2 = 1e-18;

}  // namespace

void ObservationRow::add(Index offset, std::span<const double> coefficients) {
  assert(count < static_cast<int>(parts.size()) && coefficients.size() <= std::size(Part{}.coefficients));
  Part& part = parts[static_cast<std::size_t>(count++)];
  part.offset = offset;
  part.size = static_cast<Index>(coefficients.size());
  std::copy(coefficients.begin(), coefficients.end(), part.coefficients.begin());
}

JointState::JointState(const Pose2& T_map_body, const Eigen::Matrix3d& covariance) {
  grow();
  const Index pose = allocate(BlockKind::pose);
  assert(pose == kPose);
  mean_.segment<3>(pose) = T_map_body.vector();
  for (Index c = 0; c < 3; ++c)
    for (Index r = c; r < 3; ++r) element(r, c) = covariance(r, c);
}

void JointState::covariance(std::span<const Index> rows, std::span<const Index> columns,
                            Eigen::Ref<Eigen::MatrixXd> out) const {
  for (std::size_t c = 0; c < columns.size(); ++c)
    for (std::size_t r = 0; r < rows.size(); ++r)
      out(static_cast<Index>(r), static_cast<Index>(c)) = covariance(rows[r], columns[c]);
}

void JointState::covariance(std::span<const Index> entries, PackedSymmetric& out) const {
  out.resize(entries.size());
  for (std::size_t c = 0; c < entries.size(); ++c) {
    const double* column = triangle_.data() + at(0, entries[c]);
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
      if (entries[r] != kNoEntry) element(entries[r], entries[c]) = *from;
  }
}

double JointState::covariance(const ObservationRow& a, const ObservationRow& b) const {
  double sum = 0.0;
  for (int p = 0; p < a.count; ++p)
    for (int q = 0; q < b.count; ++q) {
      const auto& pa = a.parts[static_cast<std::size_t>(p)];
      const auto& pb = b.parts[static_cast<std::size_t>(q)];
      for (Index i = 0; i < pa.size; ++i)
        for (Index j = 0; j < pb.size; ++j)
          sum += pa.coefficients[static_cast<std::size_t>(i)] * pb.coefficients[static_cast<std::size_t>(j)] *
                 covariance(pa.offset + i, pb.offset + j);
    }
  return sum;
}

Eigen::Matrix3d JointState::pose_covariance(Index block) const {
  Eigen::Matrix3d P;
  for (Index c = 0; c < 3; ++c)
    for (Index r = 0; r < 3; ++r) P(r, c) = covariance(block + r, block + c);
  return P;
}

Eigen::Matrix2d JointState::position_covariance(Index block) const {
  Eigen::Matrix2d P;
  for (Index c = 0; c < 2; ++c)
    for (Index r = 0; r < 2; ++r) P(r, c) = covariance(block + r, block + c);
  return P;
}

void JointState::move_robot(const Pose2& T_map_body, const Eigen::Matrix3d& G, const Eigen::Matrix3d& noise) {
  static_assert(kPose == 0, "the robot's columns lie wholly below the diagonal block");
  const Eigen::Matrix3d P = G * pose_covariance() * G.transpose() + noise;
  for (Index c = 0; c < 3; ++c)
    for (Index r = c; r < 3; ++r) element(r, c) = P(r, c);
  for (Index i = 3; i < extent_; ++i) {  // P_vm <- G P_vm
    const Eigen::Vector3d column = G * Eigen::Vector3d(triangle_[at(i, 0)], triangle_[at(i, 1)], triangle_[at(i, 2)]);
    for (Index c = 0; c < 3; ++c) triangle_[at(i, c)] = column(c);
  }
  mean_.segment<3>(kPose) = T_map_body.vector();
}

void JointState::inflate_robot(const Eigen::Matrix3d& noise) {
  for (Index c = 0; c < 3; ++c)
    for (Index r = c; r < 3; ++r) element(r, c) += noise(r, c);
}

void JointState::replace_robot(const Pose2& T_map_body, std::span<const Index> sources,
                               const Eigen::Matrix3Xd& jacobian, const Eigen::Matrix3d& noise) {
  assert(jacobian.cols() == static_cast<Index>(sources.size()));
  // P_vm = J P_sources,m, then P_vv = J P_sources,v + noise: no source is one of the entries that are written.
  const auto combine = [&](Index r, Index column) {
    double sum = 0.0;
    for (std::size_t s = 0; s < sources.size(); ++s)
      sum += jacobian(r, static_cast<Index>(s)) * covariance(sources[s], column);
    return sum;
  };
  D_.topRows<3>().setZero();
  for (std::size_t s = 0; s < sources.size(); ++s)
    D_.topRows<3>() += jacobian.col(static_cast<Index>(s)) * D_.row(sources[s]);
  for (Index i = 3; i < extent_; ++i)
    for (Index r = 0; r < 3; ++r) element(i, r) = combine(r, i);
  for (Index c = 0; c < 3; ++c)
    for (Index r = c; r < 3; ++r) element(r, c) = combine(r, c) + noise(r, c);
  mean_.segment<3>(kPose) = T_map_body.vector();
}

Index JointState::clone_robot() {
  const Index clone = allocate(BlockKind::pose);
  for (Index c = 0; c < 3; ++c) {
    for (Index i = 0; i < extent_; ++i)
      if (i < clone || i >= clone + 3) element(clone + c, i) = covariance(kPose + c, i);
    mean_(clone + c) = mean_(kPose + c);
    D_.row(clone + c) = D_.row(kPose + c);
  }
  for (Index c = 0; c < 3; ++c)
    for (Index r = c; r < 3; ++r) element(clone + r, clone + c) = covariance(kPose + r, kPose + c);
  return clone;
}

Index JointState::add(BlockKind kind, const Eigen::Ref<const Eigen::VectorXd>& mean, std::span<const Index> sources,
                      const Eigen::Ref<const Eigen::MatrixXd>& jacobian,
                      const Eigen::Ref<const Eigen::MatrixXd>& noise) {
  const Index size = size_of(kind);
  assert(mean.size() == size && jacobian.rows() == size && noise.rows() == size && noise.cols() == size);
  assert(jacobian.cols() == static_cast<Index>(sources.size()));
  const Index block = allocate(kind);
  // P_new,* = J P_sources,* for all that was there before (the new entries are still zero).
  for (Index i = 0; i < extent_; ++i) {
    if (i >= block && i < block + size) continue;
    for (Index r = 0; r < size; ++r) {
      double sum = 0.0;
      for (Index s = 0; s < jacobian.cols(); ++s)
        sum += jacobian(r, s) * covariance(sources[static_cast<std::size_t>(s)], i);
      element(block + r, i) = sum;
    }
  }
  for (Index c = 0; c < size; ++c)
    for (Index r = c; r < size; ++r) {
      double sum = noise(r, c);
      for (Index s = 0; s < jacobian.cols(); ++s)
        sum += covariance(block + r, sources[static_cast<std::size_t>(s)]) * jacobian(c, s);
      element(block + r, block + c) = sum;
    }
  mean_.segment(block, size) = mean;
  for (Index s = 0; s < jacobian.cols(); ++s)
    for (Index r = 0; r < size; ++r) D_.row(block + r) += jacobian(r, s) * D_.row(sources[static_cast<std::size_t>(s)]);
  return block;
}

void JointState::remove(Index block, BlockKind kind) { release(block, size_of(kind)); }

void JointState::promote(Index block, const Eigen::Vector2d& position, const Eigen::Matrix<double, 2, 4>& jacobian) {
  replace_by_fewer<2, 4>(block, position, jacobian);
}

void JointState::promote(Index block, const Eigen::Vector3d& position, const Eigen::Matrix<double, 3, 5>& jacobian) {
  replace_by_fewer<3, 5>(block, position, jacobian);
  entries_[static_cast<std::size_t>(block + 2)] = Entry::plain;
}

/// P <- J P J^T for the block's entries, of which the last ones become a gap.
template <int New, int Old>
void JointState::replace_by_fewer(Index block, const Eigen::Matrix<double, New, 1>& mean,
                                  const Eigen::Matrix<double, New, Old>& jacobian) {
  Eigen::Matrix<double, Old, Old> old;
  for (Index c = 0; c < Old; ++c)
    for (Index r = 0; r < Old; ++r) old(r, c) = covariance(block + r, block + c);
  for (Index i = 0; i < extent_; ++i) {
    if (i >= block && i < block + Old) continue;
    Eigen::Matrix<double, Old, 1> column;
    for (Index r = 0; r < Old; ++r) column(r) = covariance(block + r, i);
    const Eigen::Matrix<double, New, 1> promoted = jacobian * column;
    for (Index r = 0; r < New; ++r) element(block + r, i) = promoted(r);
  }
  const Eigen::Matrix<double, New, New> P = jacobian * old * jacobian.transpose();
  for (Index c = 0; c < New; ++c)
    for (Index r = c; r < New; ++r) element(block + r, block + c) = P(r, c);
  mean_.segment<New>(block) = mean;
  const Eigen::Matrix<double, Old, 2> D_old = D_.template middleRows<Old>(block);
  D_.template middleRows<New>(block) = jacobian * D_old;
  release(block + New, Old - New);
}

bool JointState::update(std::span<const ObservationRow> rows, Retraction retraction) {
  if (rows.empty()) return true;
  const Index count = static_cast<Index>(rows.size());
  if (S_.rows() < count) reserve_rows(2 * count);
  compute_gain(rows);
  if (!whiten(rows)) return false;
  if (holds()) {
    correct_free(count);
    correct_considered(rows, Retraction::additive);
    return true;
  }
  correct_mean(count, retraction);
  correct_considered(rows, retraction);
  for (Index k = 0; k < count; ++k) Z(k) = W(k);
  const Index shear_columns = retraction == Retraction::invariant ? append_shear(count) : 0;
  subtract_symmetric_product({triangle_.data(), extent_, stride_}, W_.data(), Z_.data(), stride_,
                             count + shear_columns);
  return true;
}

/// W = P H^T and S = H W + R (lower triangle).
void JointState::compute_gain(std::span<const ObservationRow> rows) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    auto column = W(static_cast<Index>(k));
    column.setZero();
    for (int p = 0; p < rows[k].count; ++p)
      add_columns_below(rows[k].parts[static_cast<std::size_t>(p)], column.data());
  }
  add_rows_left(rows);
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t c = 0; c <= r; ++c) {
      double sum = r == c ? rows[r].variance : 0.0;
      for (int p = 0; p < rows[r].count; ++p) {
        const auto& part = rows[r].parts[static_cast<std::size_t>(p)];
        for (Index i = 0; i < part.size; ++i)
          sum += part.coefficients[static_cast<std::size_t>(i)] * W(static_cast<Index>(c))(part.offset + i);
      }
      S_(static_cast<Index>(r), static_cast<Index>(c)) = sum;
    }
}

/// out += P(:, part) * coefficients, from the part's first row down.
void JointState::add_columns_below(const ObservationRow::Part& part, double* out) const {
  const Index end = part.offset + part.size;
  const auto& h = part.coefficients;
  for (Index i = part.offset; i < end; ++i)
    for (Index s = 0; s < part.size; ++s) out[i] += h[static_cast<std::size_t>(s)] * covariance(i, part.offset + s);
  const double* p = triangle_.data() + at(0, part.offset);
  const Index n = extent_ - end;
  const auto column = [&](Index s) { return Eigen::Map<const Eigen::VectorXd>(p + s * stride_ + end, n); };
  Eigen::Map<Eigen::VectorXd> below(out + end, n);
  switch (part.size) {  // in one pass, since memory is what takes time
    case 2:
      below += h[0] * column(0) + h[1] * column(1);
      break;
    case 3:
      below += h[0] * column(0) + h[1] * column(1) + h[2] * column(2);
      break;
    case 5:
      below += h[0] * column(0) + h[1] * column(1) + h[2] * column(2) + h[3] * column(3) + h[4] * column(4);
      break;
    default:
      for (Index s = 0; s < part.size; ++s) below += h[static_cast<std::size_t>(s)] * column(s);
  }
}

/// The rest of P H^T, above the parts. There a part's entries are adjacent rows of each column of the triangle; all
/// parts are served column by column, since columns lie pages apart.
void JointState::add_rows_left(std::span<const ObservationRow> rows) {
  sort_parts(rows);
  auto first = parts_.begin();
  for (Index i = 0; i < extent_; ++i) {
    while (first != parts_.end() && first->part.offset <= i) ++first;
    if (first == parts_.end()) return;
    const double* column = triangle_.data() + at(0, i);
    for (auto placed = first; placed != parts_.end(); ++placed) {
      const auto& [offset, size, h] = placed->part;
      double sum = h[0] * column[offset];
      for (Index s = 1; s < size; ++s) sum += h[static_cast<std::size_t>(s)] * column[offset + s];
      W_[at(i, placed->row)] += sum;
    }
  }
}

void JointState::sort_parts(std::span<const ObservationRow> rows) {
  parts_.clear();
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (int p = 0; p < rows[k].count; ++p)
      parts_.push_back({rows[k].parts[static_cast<std::size_t>(p)], static_cast<Index>(k)});
  std::sort(parts_.begin(), parts_.end(), [](const PlacedPart& a, const PlacedPart& b) {
    return a.part.offset != b.part.offset ? a.part.offset < b.part.offset : a.row < b.row;
  });
}

/// S = L L^T, W <- W L^-T, innovation <- L^-1 innovation.
bool JointState::whiten(std::span<const ObservationRow> rows) {
  const Index count = static_cast<Index>(rows.size());
  for (Index r = 0; r < count; ++r) {
    for (Index c = 0; c <= r; ++c) {
      double sum = S_(r, c);
      for (Index k = 0; k < c; ++k) sum -= S_(r, k) * S_(c, k);
      if (c < r)
        S_(r, c) = sum / S_(c, c);
      else if (sum > 0.0)
        S_(r, r) = std::sqrt(sum);
      else
        return false;
    }
    double sum = rows[static_cast<std::size_t>(r)].innovation;
    for (Index k = 0; k < r; ++k) sum -= S_(r, k) * whitened_innovation_(k);
    whitened_innovation_(r) = sum / S_(r, r);
  }
  whiten_columns(W_.data(), stride_, extent_, S_.data(), S_.outerStride(), count);
  return true;
}

/// x <- x + K nu. Leaves in shear_ by how much each position moved, turned by a right angle.
void JointState::correct_mean(Index rows, Retraction retraction) {
  auto correction = correction_.head(extent_);
  correction.setZero();
  for (Index k = 0; k < rows; ++k) correction.noalias() += whitened_innovation_(k) * W(k);
  const double turn_rad = correction(kHeading);
  const InvariantMotion turn(turn_rad);
  shear_.head(extent_).setZero();
  for (Index i = 0; i < extent_; ++i) {
    if (entries_[static_cast<std::size_t>(i)] == Entry::angle) {
      mean_(i) = wrap(mean_(i) + correction(i));
    } else if (entries_[static_cast<std::size_t>(i)] == Entry::x) {
      const Eigen::Vector2d q = mean_.segment<2>(i), dq = correction.segment<2>(i);
      if (retraction == Retraction::invariant) {
        mean_.segment<2>(i) = turn.apply(q, dq);
        shear_.segment<2>(i) = perpendicular(mean_.segment<2>(i) - q);
      } else {
        mean_.segment<2>(i) = q + dq;
      }
    } else if (entries_[static_cast<std::size_t>(i)] == Entry::plain) {
      mean_(i) += correction(i);
    }
  }
}

/// What is held takes no gain: x_f <- x_f + K_f nu, P_ff <- P_ff - W_f W_f^T, P_hf <- P_hf - W_h W_f^T, and P_hh stays.
void JointState::correct_free(Index rows) {
  for (Index c = 0; c < held_from_; ++c) {
    Eigen::Map<Eigen::VectorXd> column(triangle_.data() + at(c, c), extent_ - c);
    for (Index k = 0; k < rows; ++k) column.noalias() -= W(k)(c) * W(k).tail(extent_ - c);
    correct_entry(c, rows);
  }
}

void JointState::correct_entry(Index entry, Index rows) {
  for (Index k = 0; k < rows; ++k) mean_(entry) += whitened_innovation_(k) * W(k)(entry);
  if (entries_[static_cast<std::size_t>(entry)] == Entry::angle) mean_(entry) = wrap(mean_(entry));
}

/// The covariance is kept in coordinates (position, heading) at the present mean. The invariant error did not change
/// when the mean moved, so those coordinates did: P <- T P T^T with T = I + u e_heading^T and u = (q+ - q)_perp, that
/// is P += u v^T + v u^T with v = P e_heading + u P_heading / 2, P being the covariance after the update.
Index JointState::append_shear(Index count) {
  auto v = W(count + 1);
  for (Index i = 0; i < extent_; ++i) v(i) = covariance(i, kHeading);
  for (Index k = 0; k < count; ++k) v.noalias() -= W(k)(kHeading) * W(k);
  if (!(v(kHeading) > kCertainHeading_rad2)) return 0;
  const auto u = shear_.head(extent_);
  v += 0.5 * v(kHeading) * u;
  W(count) = u;
  Z(count) = -v;
  Z(count + 1) = -u;
  return kShearColumns;
}

Index JointState::allocate(BlockKind kind) {
  assert(!holds());
  const Index size = size_of(kind);
  auto& gaps = gaps_[static_cast<std::size_t>(size)];
  Index block;
  if (!gaps.empty()) {
    block = gaps.back();
    gaps.pop_back();
  } else {
    while (extent_ + size > capacity_) grow();
    block = extent_;
    extent_ += size;
    for (Index i = block; i < extent_; ++i)
      for (Index j = 0; j < extent_; ++j) element(i, j) = 0.0;
  }
  using Tags = std::array<Entry, kLargest>;  // the rest of a block are gaps
  static constexpr std::array<Tags, 7> kTags{{{Entry::x, Entry::y, Entry::angle},
                                              {Entry::x, Entry::y},
                                              {Entry::x, Entry::y, Entry::angle, Entry::plain},
                                              {Entry::angle},
                                              {Entry::plain, Entry::plain},
                                              {Entry::x, Entry::y, Entry::x, Entry::y, Entry::plain},
                                              {Entry::x, Entry::y, Entry::plain}}};
  for (Index i = 0; i < size; ++i)
    entries_[static_cast<std::size_t>(block + i)] = kTags[static_cast<std::size_t>(kind)][static_cast<std::size_t>(i)];
  return block;
}

void JointState::release(Index first, Index count) {
  for (Index i = first; i < first + count; ++i) {
    for (Index j = 0; j < extent_; ++j) element(i, j) = 0.0;
    mean_(i) = 0.0;
    D_.row(i).setZero();
    entries_[static_cast<std::size_t>(i)] = Entry::gap;
  }
  gaps_[static_cast<std::size_t>(count)].push_back(first);
}

void JointState::grow() {
  const Index capacity = std::max(kFirstCapacity, 2 * capacity_), stride = capacity + kPadding;
  AlignedVector triangle(static_cast<std::size_t>(stride * capacity), 0.0);
  for (Index c = 0; c < extent_; ++c)
    std::copy_n(triangle_.data() + at(c, c), extent_ - c, triangle.data() + c * stride + c);
  triangle_ = std::move(triangle);
  capacity_ = capacity;
  stride_ = stride;
  mean_.conservativeResizeLike(Eigen::VectorXd::Zero(capacity));
  D_.conservativeResizeLike(Eigen::Matrix<double, Eigen::Dynamic, 2>::Zero(capacity, 2));
  entries_.resize(static_cast<std::size_t>(capacity), Entry::gap);
  reserve_rows(std::max(S_.rows(), kFirstRows));
  correction_.resize(capacity);
  shear_.resize(capacity);
  for (auto& gaps : gaps_) gaps.reserve(static_cast<std::size_t>(capacity));
}

void JointState::reserve_rows(Index rows) {
  const auto size = static_cast<std::size_t>(stride_ * (rows + kShearColumns));
  W_.assign(size, 0.0);  // the padding too: it is computed with, although nobody asks for it
  Z_.assign(size, 0.0);
  S_.resize(rows, rows);
  whitened_innovation_.resize(rows);
  whitened_HD_.resize(rows, 2);
  parts_.reserve(static_cast<std::size_t>(rows) * std::tuple_size_v<decltype(ObservationRow::parts)>);
}

}  // namespace azimuth
