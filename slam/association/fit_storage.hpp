#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace azimuth {

/// Resizes `storage` to `size` values that are to be written next; until then their contents are unspecified. Capacity
/// is never released. Thread contract: reentrant.
template <class T>
void fit(std::vector<T>& storage, std::size_t size) {
  if (storage.capacity() < size) storage.reserve(2 * size);  // with slack, so that it seldom grows
  storage.resize(size);
}

/// Resizes `storage` and fills it with `value`. Capacity is never released. Thread contract: reentrant.
template <class T>
void fit(std::vector<T>& storage, std::size_t size, T value) {
  fit(storage, size);
  std::ranges::fill(storage, value);
}

}  // namespace azimuth
