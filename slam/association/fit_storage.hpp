#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace azimuth {

/// As many places for values that are written next, in storage that is kept; what they hold until then is unspecified.
/// Thread contract: reentrant.
template <class T>
void fit(std::vector<T>& storage, std::size_t size) {
  if (storage.capacity() < size) storage.reserve(2 * size);  // with slack, so that it seldom grows
  storage.resize(size);
}

/// As many values of one kind, in storage that is kept. Thread contract: reentrant.
template <class T>
void fit(std::vector<T>& storage, std::size_t size, T value) {
  fit(storage, size);
  std::ranges::fill(storage, value);
}

}  // namespace azimuth
