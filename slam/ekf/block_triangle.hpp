#pragma once
#include <array>
#include <cstddef>
#include <new>
#include <vector>

#include "slam/ekf/observation_row.hpp"
#include "slam/ekf/rank_update.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {

/// Allocator whose memory starts at a cache line.
template <class T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::align_val_t kLine{64};

  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}  // NOLINT(google-explicit-constructor): allocators convert

  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), kLine)); }
  void deallocate(T* data, std::size_t) { ::operator delete(data, kLine); }
  friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};

/// Storage for vector instructions: an operand as wide as a cache line must not straddle two lines.
using AlignedVector = std::vector<double, CacheLineAllocator<double>>;

/// A symmetric matrix over blocks of rows that are added and removed, stored as one lower triangle that grows by
/// doubling. A released block leaves a gap that the next block of its size fills, so adding and removing costs one row
/// and column and never moves the matrix. Entries of gaps are zero.
///
/// Thread contract: thread-bound. Nothing allocates unless the matrix grows beyond its largest size so far.
class BlockTriangle {
 public:
  static constexpr Index kLargestBlock = 5;

  /// One beyond the last row in use, gaps included.
  Index extent() const { return extent_; }
  /// `capacity`: number of rows for which there is storage. `stride`: doubles from one column to the next.
  Index capacity() const { return capacity_; }
  Index stride() const { return stride_; }

  double operator()(Index row, Index column) const {
    return row >= column ? storage_[at(row, column)] : storage_[at(column, row)];
  }
  double& element(Index row, Index column) { return storage_[row >= column ? at(row, column) : at(column, row)]; }

  /// The rows from the diagonal down belong to the matrix; those above are scratch.
  double* column(Index column) { return storage_.data() + at(0, column); }
  const double* column(Index column) const { return storage_.data() + at(0, column); }
  LowerTriangle lower() { return {storage_.data(), extent_, stride_}; }

  /// H_a P H_b^T.
  double between(const ObservationRow& a, const ObservationRow& b) const;
  /// H_a P H_b^T for each row of `a` with each row of `b`. The rows of a pair have the same parts.
  Eigen::Matrix2d between(const RowPair& a, const RowPair& b) const;

  /// Returns the first of `size` adjacent rows, which are zero.
  Index allocate(Index size);
  /// Turns `size` rows, at most kLargestBlock, into a gap.
  void release(Index first, Index size);

 private:
  std::size_t at(Index row, Index column) const { return as_size(column * stride_ + row); }
  void grow();

  Index capacity_ = 0, stride_ = 0, extent_ = 0;
  AlignedVector storage_;                                   // column-major
  std::array<std::vector<Index>, kLargestBlock + 1> gaps_;  // first rows, by size of the gap
};

}  // namespace azimuth
