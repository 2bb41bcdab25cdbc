#pragma once
#include <cstddef>
#include <vector>

namespace azimuth {

/// As many values of one kind, in storage that is kept. Thread contract: reentrant.
template <class T>
void fit(std::vector<T>& storage, std::size_t size, T value) {
  if (storage.capacity() < size) storage.reserve(2 * size);  // with slack, so that it seldom grows
  storage.assign(size, value);
}

}  // namespace azimuth
