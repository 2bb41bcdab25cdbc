#include "slam/ekf/block_triangle.hpp"

#include <algorithm>
#include <utility>

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
      const auto& pa = a.parts[static_cast<std::size_t>(p)];
      const auto& pb = b.parts[static_cast<std::size_t>(q)];
      for (Index i = 0; i < pa.size; ++i)
        for (Index j = 0; j < pb.size; ++j)
          sum += pa.coefficients[static_cast<std::size_t>(i)] * pb.coefficients[static_cast<std::size_t>(j)] *
                 (*this)(pa.offset + i, pb.offset + j);
    }
  return sum;
}

Index BlockTriangle::allocate(Index size) {
  auto& gaps = gaps_[static_cast<std::size_t>(size)];
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
  gaps_[static_cast<std::size_t>(size)].push_back(first);
}

void BlockTriangle::grow() {
  const Index capacity = std::max(kFirstCapacity, 2 * capacity_), stride = capacity + kPadding;
  AlignedVector storage(static_cast<std::size_t>(stride * capacity), 0.0);
  for (Index c = 0; c < extent_; ++c)
    std::copy_n(storage_.data() + at(c, c), extent_ - c, storage.data() + c * stride + c);
  storage_ = std::move(storage);
  capacity_ = capacity;
  stride_ = stride;
  for (auto& gaps : gaps_) gaps.reserve(static_cast<std::size_t>(capacity));
}

}  // namespace azimuth
