// Any bytes as a map file. Reading must be safe, and the result must be written as the same bytes. Size and checksum
// are corrected first, because no fuzzer finds them.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>
#include <zlib.h>

#include "drivers/storage/map_codec.hpp"

namespace {

constexpr std::size_t kSizeAt = 16, kSumSize = 4;

void put(std::vector<std::byte>& bytes, std::size_t at, std::uint64_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) bytes[at + i] = static_cast<std::byte>(value >> (8 * i) & 0xffU);
}

void seal(std::vector<std::byte>& bytes) {
  std::memcpy(bytes.data(), azimuth::kMapMagic.data(), azimuth::kMapMagic.size());
  put(bytes, kSizeAt, bytes.size(), 8);
  const std::size_t size = bytes.size() - kSumSize;
  put(bytes, size, crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), size), kSumSize);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto* const first = reinterpret_cast<const std::byte*>(data);
  std::vector<std::byte> bytes(first, first + size);
  azimuth::MapSnapshot map;
  static_cast<void>(azimuth::decode_map(bytes, map));
  if (size < kSizeAt + 8 + kSumSize) return 0;
  seal(bytes);
  if (azimuth::decode_map(bytes, map)) return 0;
  std::vector<std::byte> again;
  azimuth::encode(map, again);
  if (again != bytes) std::abort();
  return 0;
}
