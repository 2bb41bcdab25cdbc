#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace azimuth {

using Bytes = std::span<const std::byte>;

/// A view of `bytes` as characters.
inline std::string_view as_text(Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

/// The little-endian number at the start of `bytes`. Missing bytes count as zero.
template <class Integer>
Integer little_endian(Bytes bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(Integer) && i < bytes.size(); ++i)
    value |= std::to_integer<std::uint64_t>(bytes[i]) << (8 * i);
  return static_cast<Integer>(value);
}

}  // namespace azimuth
