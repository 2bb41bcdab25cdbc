#include "slam/ekf/block_triangle.hpp"

#include <algorithm>
#include <utility>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr Index kFirstCapacity = 64;
// Keeps columns from starting a power of two apart, where they would share cache sets; a whole tile of the rank update.
constexpr Index kPadding = LowerTriangle::kTile;
static_assert(kFirstCapacity % LowerTriangle::kTile == 0);

}  // namespace

double BlockTriangle::between(const ObservationRow& a, const ObservationRow& b) const {
  double sum = 0.0;
  for (int p = 0; p < a.count; ++p)
    for (int q = 0; q < b.count; ++q) {
      const auto& pa = a.parts[as_size(p)];
      const auto& pb = b.parts[as_size(q)];
      for (Index i = 0; i < pa.size; ++i)
        for (Index j = 0; j < pb.size; ++j)
          sum += pa.coefficients[as_size(i)] * pb.coefficients[as_size(j)] * (*this)(pa.offset + i, pb.offset + j);
    }
  return sum;
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
