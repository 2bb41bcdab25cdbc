// Any bytes as a file of kept odometry. Reading must be safe, and the result must be written as the same bytes. Magic
// and checksum are corrected first, because no fuzzer finds them.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>
#include <zlib.h>

#include "drivers/storage/kept_odometry.hpp"

namespace {

constexpr std::size_t kSumSize = 4;

void seal(std::vector<std::byte>& bytes) {
  std::memcpy(bytes.data(), azimuth::kKeptOdometryMagic.data(), azimuth::kKeptOdometryMagic.size());
  const auto sum =
      static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size() - kSumSize));
  for (std::size_t i = 0; i < kSumSize; ++i)
    bytes[bytes.size() - kSumSize + i] = static_cast<std::byte>(sum >> (8 * i) & 0xffU);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto* const first = reinterpret_cast<const std::byte*>(data);
  std::vector<std::byte> bytes(first, first + size), again;
  static_cast<void>(azimuth::decode_kept_odometry(bytes));
  azimuth::encode(azimuth::KeptOdometry{}, again);
  bytes.resize(again.size());
  seal(bytes);
  if (const auto kept = azimuth::decode_kept_odometry(bytes)) {
    azimuth::encode(*kept, again);
    if (again != bytes) std::abort();
  }
  return 0;
}
