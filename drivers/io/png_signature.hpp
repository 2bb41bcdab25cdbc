#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace azimuth {

/// Whether a file claims to be a PNG image: its first 8 bytes.
inline bool is_png(std::span<const std::byte> file) {
  constexpr std::array<unsigned char, 8> kSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  const auto same = [](unsigned char a, std::byte b) { return std::byte{a} == b; };
  return file.size() >= kSignature.size() && std::equal(kSignature.begin(), kSignature.end(), file.begin(), same);
}

}  // namespace azimuth
