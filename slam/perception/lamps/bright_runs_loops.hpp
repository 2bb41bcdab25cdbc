#pragma once
// The loops of bright_runs.hpp, included once for each instruction set that they are compiled for, with kLanes pixels
// to a register. All names here have internal linkage, and no code calls the standard library, so the linker cannot
// merge code for different processors.

#include "slam/perception/lamps/bright_runs.hpp"

#if defined(__ARM_NEON)
#include <arm_neon.h>
#endif

namespace azimuth {
namespace {

// NOLINTBEGIN(misc-definitions-in-headers): a copy for each instruction set is the point
#if defined(__AVX2__)
constexpr int kLanes = 32;
#else
constexpr int kLanes = 16;
#endif
constexpr int kLanesAtOnce = 4 * kLanes;
// NOLINTEND(misc-definitions-in-headers)
using Pixels = std::uint8_t __attribute__((vector_size(kLanes)));
using PixelsAnywhere [[gnu::aligned(1), gnu::may_alias]] = Pixels;  // In memory, without alignment
using Chars = char __attribute__((vector_size(kLanes)));

/// Collects the columns at which runs of bright pixels begin and end.
struct Edges {
  PixelRun* out;
  std::size_t room;
  int row;
  std::size_t count = 0;
  bool inside = false;

  /// `shining` has one bit for each of the kLanes pixels from `u` on.
  void add(std::uint32_t shining, int u) {
    constexpr std::uint32_t kAll = static_cast<std::uint32_t>((std::uint64_t{1} << kLanes) - 1);
    std::uint32_t edges = (shining ^ ((shining << 1U) | static_cast<std::uint32_t>(inside))) & kAll;
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

// A cast instead of memcpy: GCC copies through the stack for memcpy on arm64.
inline Pixels load(const std::uint8_t* from) { return *reinterpret_cast<const PixelsAnywhere*>(from); }

inline Pixels brighter(const Pixels& a, const Pixels& b) { return a > b ? a : b; }

/// Returns one bit for each pixel of at least `level`.
inline std::uint32_t at_least(const Pixels& pixels, const Pixels& level) {
  const auto mask = pixels >= level;
#if defined(__AVX2__)
  return static_cast<std::uint32_t>(__builtin_ia32_pmovmskb256((Chars)mask));
#elif defined(__SSE2__)
  return static_cast<std::uint32_t>(__builtin_ia32_pmovmskb128((Chars)mask));
#elif defined(__ARM_NEON)
  const auto bits = (uint8x16_t)mask & uint8x16_t{1, 2, 4, 8, 16, 32, 64, 128, 1, 2, 4, 8, 16, 32, 64, 128};
  return vaddv_u8(vget_low_u8(bits)) | static_cast<std::uint32_t>(vaddv_u8(vget_high_u8(bits))) << 8U;
#else
  std::uint32_t bits = 0;
  for (int i = 0; i < kLanes; ++i) bits |= (static_cast<std::uint32_t>(mask[i]) & 1U) << i;
  return bits;
#endif
}

/// Whether any of kLanesAtOnce pixels is at least `level`.
inline bool any(const std::uint8_t* pixels, const Pixels& level) {
  const Pixels brightest = brighter(brighter(load(pixels), load(pixels + kLanes)),
                                    brighter(load(pixels + 2 * kLanes), load(pixels + 3 * kLanes)));
  return at_least(brightest, level) != 0;
}

inline std::size_t find_bright_runs(const std::uint8_t* pixels, const PixelRun& where, int level, PixelRun* out,
                                    std::size_t room) {
  const Pixels levels = Pixels{} + static_cast<std::uint8_t>(level);
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

}  // namespace
}  // namespace azimuth
