#pragma once
#include <cstddef>
#include <new>
#include <vector>

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

}  // namespace azimuth
