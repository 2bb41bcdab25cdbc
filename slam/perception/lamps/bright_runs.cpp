#include "slam/perception/lamps/bright_runs.hpp"

#include <bit>
#include <cstring>

namespace azimuth {
namespace {

constexpr std::uint64_t kHighBits = 0x8080808080808080ULL, kLowBits = ~kHighBits, kOnes = 0x0101010101010101ULL;

/// Whether one of eight pixels is of `level` or more: added to what is missing from `level` to the next power of two,
/// the lower seven bits of each carry into the eighth.
class EightPixels {
 public:
  explicit EightPixels(int level)
      : high_(level > 128), missing_(kOnes * static_cast<std::uint64_t>(level > 128 ? 256 - level : 128 - level)) {}

  bool shine(const std::uint8_t* pixels) const {
    std::uint64_t word;
    std::memcpy(&word, pixels, sizeof word);
    const std::uint64_t carried = (word & kLowBits) + missing_;
    return ((high_ ? carried & word : carried | word) & kHighBits) != 0;
  }

 private:
  bool high_;
  std::uint64_t missing_;
};

}  // namespace

std::size_t bright_runs(const std::uint8_t* pixels, const PixelRun& where, int level, PixelRun* out, std::size_t room) {
#if defined(__x86_64__)
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  if (has_avx2) return avx2::bright_runs(pixels, where, level, out, room);
#endif
  return portable::bright_runs(pixels, where, level, out, room);
}

namespace portable {

std::size_t bright_runs(const std::uint8_t* pixels, const PixelRun& where, int level, PixelRun* out, std::size_t room) {
  const EightPixels eight(level);
  std::size_t count = 0;
  int u = where.first;
  while (count < room) {
    while (u + 8 <= where.last && !eight.shine(pixels + u)) u += 8;
    while (u < where.last && pixels[u] < level) ++u;
    if (u == where.last) break;
    const int first = u;
    while (u < where.last && pixels[u] >= level) ++u;
    out[count++] = {where.row, first, u};
  }
  return count;
}

}  // namespace portable

}  // namespace azimuth
