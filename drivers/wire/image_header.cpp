#include "drivers/wire/image_header.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace azimuth {

namespace {

int byte_at(Bytes file, std::size_t at) { return std::to_integer<int>(file[at]); }
int word_at(Bytes file, std::size_t at) { return 256 * byte_at(file, at) + byte_at(file, at + 1); }

/// True: one of the markers SOF0 to SOF15, without the table markers in that range.
bool begins_frame(int marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

}  // namespace

std::optional<std::pair<int, int>> jpeg_size(Bytes file) {
  constexpr std::size_t kMarker = 2, kFrameHeader = 9;  // marker, length, precision, height, width
  if (file.size() < kMarker || word_at(file, 0) != 0xFFD8) return std::nullopt;
  std::size_t at = kMarker;
  while (at + kFrameHeader <= file.size()) {
    const int marker = byte_at(file, at + 1);
    const bool padding = byte_at(file, at) != 0xFF || marker == 0xFF || marker == 0x00;
    if (padding) {
      ++at;
      continue;
    }
    if (begins_frame(marker)) return std::pair{word_at(file, at + 7), word_at(file, at + 5)};
    if (marker == 0xD9 || marker == 0xDA) return std::nullopt;
    const bool alone = marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8);
    at += alone ? kMarker : kMarker + static_cast<std::size_t>(word_at(file, at + 2));
  }
  return std::nullopt;
}

bool is_png(Bytes file) {
  constexpr std::array<unsigned char, 8> kSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  const auto same = [](unsigned char a, std::byte b) { return std::byte{a} == b; };
  return file.size() >= kSignature.size() && std::equal(kSignature.begin(), kSignature.end(), file.begin(), same);
}

}  // namespace azimuth
