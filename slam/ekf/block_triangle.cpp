#include "slam/ekf/block_triangle.hpp"

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr Index kFirstCapacity = 64;
// Keeps columns from starting a power of two apart, where they would share cache sets. One tile of the rank update.
constexpr Index kPadding = LowerTriangle::kTile;
static_assert(kFirstCapacity % LowerTriangle::kTile == 0);

/// The block of P at the rows of one part and the columns of another: its first element, and the steps to the next row
/// and the next column. Undefined for two parts that overlap, since their block contains the diagonal.
struct Meeting {
  const double* first;
  Index to_next_row, to_next_column;
};

std::optional<Meeting> meeting(const BlockTriangle& P, const ObservationRow::Part& a, const ObservationRow::Part& b) {
  if (a.offset >= b.offset + b.size) return Meeting{P.column(b.offset) + a.offset, 1, P.stride()};
  if (b.offset >= a.offset + a.size) return Meeting{P.column(a.offset) + b.offset, P.stride(), 1};
  return std::nullopt;
}

[[maybe_unused]] bool same_parts(const ObservationRow& a, const ObservationRow& b) {
  const auto same = [](const auto& x, const auto& y) { return x.offset == y.offset && x.size == y.size; };
  return a.count == b.count && std::equal(a.parts.begin(), a.parts.begin() + a.count, b.parts.begin(), same);
}

}  // namespace

// Two parts meet in a whole block, so the side of the diagonal is decided once per block, not once per element. The
// order of summation does not depend on the side.
double BlockTriangle::between(const ObservationRow& a, const ObservationRow& b) const {
  double sum = 0.0;
  for (std::size_t p = 0; p < as_size(a.count); ++p)
    for (std::size_t q = 0; q < as_size(b.count); ++q) {
      const ObservationRow::Part &pa = a.parts[p], &pb = b.parts[q];
      const auto block = meeting(*this, pa, pb);
      for (Index i = 0; i < pa.size; ++i)
        for (Index j = 0; j < pb.size; ++j) {
          const double P_ij = block ? block->first[i * block->to_next_row + j * block->to_next_column]
                                    : (*this)(pa.offset + i, pb.offset + j);
          sum += pa.coefficients[as_size(i)] * pb.coefficients[as_size(j)] * P_ij;
        }
    }
  return sum;
}

Eigen::Matrix2d BlockTriangle::between(const RowPair& a, const RowPair& b) const {
  assert(same_parts(a[0], a[1]) && same_parts(b[0], b[1]));
  double s00 = 0.0, s01 = 0.0, s10 = 0.0, s11 = 0.0;  // each summed in the order used for a single pair of rows
  for (std::size_t p = 0; p < as_size(a[0].count); ++p)
    for (std::size_t q = 0; q < as_size(b[0].count); ++q) {
      const ObservationRow::Part &pa = a[0].parts[p], &pb = b[0].parts[q];
      const auto block = meeting(*this, pa, pb);
      for (Index i = 0; i < pa.size; ++i)
        for (Index j = 0; j < pb.size; ++j) {
          const double P_ij = block ? block->first[i * block->to_next_row + j * block->to_next_column]
                                    : (*this)(pa.offset + i, pb.offset + j);
          const double a0 = pa.coefficients[as_size(i)], a1 = a[1].parts[p].coefficients[as_size(i)];
          const double b0 = pb.coefficients[as_size(j)], b1 = b[1].parts[q].coefficients[as_size(j)];
          s00 += a0 * b0 * P_ij;
          s01 += a0 * b1 * P_ij;
          s10 += a1 * b0 * P_ij;
          s11 += a1 * b1 * P_ij;
        }
    }
  return Eigen::Matrix2d{{s00, s01}, {s10, s11}};
}

Index BlockTriangle::allocate(Index size) {
  auto& gaps = gaps_[as_size(size)];
  if (!gaps.empty()) {
    const Index block = gaps.back();
    gaps.pop_back();
    return block;
  }
  while (extent_ + size > capacity_) grow();
  const Index block = extent_;
  extent_ += size;
  for (Index i = block; i < extent_; ++i)
    for (Index j = 0; j < extent_; ++j) element(i, j) = 0.0;
  return block;
}

void BlockTriangle::release(Index first, Index size) {
  for (Index i = first; i < first + size; ++i)
    for (Index j = 0; j < extent_; ++j) element(i, j) = 0.0;
  gaps_[as_size(size)].push_back(first);
}

void BlockTriangle::grow() {
  const Index capacity = std::max(kFirstCapacity, 2 * capacity_), stride = capacity + kPadding;
  AlignedVector storage(as_size(stride * capacity), 0.0);
  for (Index c = 0; c < extent_; ++c)
    std::copy_n(storage_.data() + at(c, c), extent_ - c, storage.data() + c * stride + c);
  storage_ = std::move(storage);
  capacity_ = capacity;
  stride_ = stride;
  for (auto& gaps : gaps_) gaps.reserve(as_size(capacity));
}

}  // namespace azimuth
