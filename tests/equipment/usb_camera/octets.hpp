#pragma once
// Byte sequences of USB, with little-endian numbers.

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace azimuth::sim {

using Octets = std::vector<std::uint8_t>;
using OctetSpan = std::span<const std::uint8_t>;

template <std::unsigned_integral Number>
void put_le(Octets& into, Number number) {
  for (std::size_t i = 0; i < sizeof number; ++i) {
    into.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(number) >> (8 * i)));
  }
}

inline void put_octets(Octets& into, OctetSpan octets) { into.insert(into.end(), octets.begin(), octets.end()); }

/// The first `bytes` bytes of `octets` as a number; missing bytes count as zero.
inline std::uint64_t get_le(OctetSpan octets, std::size_t bytes) {
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < bytes && i < octets.size(); ++i) number |= std::uint64_t{octets[i]} << (8 * i);
  return number;
}

/// The bytes from `offset` on; empty beyond the end.
inline OctetSpan from_offset(OctetSpan octets, std::size_t offset) {
  return offset < octets.size() ? octets.subspan(offset) : OctetSpan{};
}

}  // namespace azimuth::sim
