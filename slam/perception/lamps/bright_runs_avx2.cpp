// Compiled with -mavx2 (CMakeLists.txt); reached only where the processor has it. Nothing of the standard library, so
// that no code for this processor can be linked into another's.

#include "slam/perception/lamps/bright_runs.hpp"

#if defined(__AVX2__)
#include <immintrin.h>

namespace azimuth::avx2 {
namespace {

constexpr int kLanes = 32, kLanesAtOnce = 4 * kLanes;

/// Collects the columns at which a row begins and ceases to shine.
struct Edges {
  PixelRun* out;
  std::size_t room;
  int row;
  std::size_t count = 0;
  bool inside = false;

  /// The pixels from `u` on, one bit each.
  void add(std::uint32_t shining, int u) {
    std::uint32_t edges = shining ^ ((shining << 1U) | static_cast<std::uint32_t>(inside));
    for (; edges != 0; edges &= edges - 1) toggle(u + __builtin_ctz(edges));
  }
  void toggle(int u) {
    if (count == room) return;
    if (!inside) out[count].first = u;
    if (inside) {
      out[count].row = row;
      out[count++].last = u;
    }
    inside = !inside;
  }
};

__m256i load(const std::uint8_t* pixels) { return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(pixels)); }

std::uint32_t at_least(__m256i pixels, __m256i level) {
  return static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_cmpeq_epi8(_mm256_max_epu8(pixels, level), pixels)));
}

/// Whether any of kLanesAtOnce pixels shines.
bool any(const std::uint8_t* pixels, __m256i level) {
  const __m256i brightest = _mm256_max_epu8(_mm256_max_epu8(load(pixels), load(pixels + kLanes)),
                                            _mm256_max_epu8(load(pixels + 2 * kLanes), load(pixels + 3 * kLanes)));
  return at_least(brightest, level) != 0;
}

}  // namespace

std::size_t bright_runs(const std::uint8_t* pixels, const PixelRun& where, int level, PixelRun* out, std::size_t room) {
  const __m256i levels = _mm256_set1_epi8(static_cast<char>(level));
  Edges edges{.out = out, .room = room, .row = where.row};
  int u = where.first;
  while (u + kLanes <= where.last) {
    if (!edges.inside && u + kLanesAtOnce <= where.last && !any(pixels + u, levels)) {
      u += kLanesAtOnce;
      continue;
    }
    edges.add(at_least(load(pixels + u), levels), u);
    u += kLanes;
  }
  for (; u < where.last; ++u)
    if ((pixels[u] >= level) != edges.inside) edges.toggle(u);
  if (edges.inside) edges.toggle(u);
  return edges.count;
}

}  // namespace azimuth::avx2

#else

namespace azimuth::avx2 {
std::size_t bright_runs(const std::uint8_t* pixels, const PixelRun& where, int level, PixelRun* out, std::size_t room) {
  return portable::bright_runs(pixels, where, level, out, room);
}
}  // namespace azimuth::avx2

#endif
