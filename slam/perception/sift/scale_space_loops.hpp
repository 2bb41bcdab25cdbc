#pragma once
// The loops of scale_space_kernels.hpp, included once for each instruction set that they are compiled for. All names
// here have internal linkage, and no code calls the standard library, so the linker cannot merge code for different
// processors. No operation depends on the number of lanes, so the bits are the same everywhere.

#include "slam/perception/sift/scale_space_kernels.hpp"

#if defined(__ARM_NEON)
#include <arm_neon.h>
#endif

namespace azimuth {
namespace {

// NOLINTBEGIN(misc-definitions-in-headers): a copy for each instruction set is the point
#if defined(__AVX2__)
constexpr int kLanes = 8;
#else
constexpr int kLanes = 4;
#endif
constexpr int kBlock = 4 * kLanes;
using Lanes = float __attribute__((vector_size(4 * kLanes)));
using LanesAnywhere [[gnu::aligned(4), gnu::may_alias]] = Lanes;  // In memory, without vector alignment
using Words = std::int32_t __attribute__((vector_size(4 * kLanes)));
using Shorts = std::uint16_t __attribute__((vector_size(2 * kLanes)));
// NOLINTEND(misc-definitions-in-headers)
static_assert(kScaleSpaceLanes % kBlock == 0);

// A cast instead of memcpy: GCC copies through the stack for memcpy on arm64.
inline void load(Lanes& value, const float* from) { value = *reinterpret_cast<const LanesAnywhere*>(from); }
inline void store(float* to, const Lanes& value) { *reinterpret_cast<LanesAnywhere*>(to) = value; }

/// Sums of kBlock neighbouring pixels. The four vectors are separate members so that they stay in registers at any
/// level of optimisation.
struct Block {
  Lanes a, b, c, d;

  void begin(const float* middle, float weight) {
    load(a, middle);
    load(b, middle + kLanes);
    load(c, middle + 2 * kLanes);
    load(d, middle + 3 * kLanes);
    a *= weight;
    b *= weight;
    c *= weight;
    d *= weight;
  }
  void add_pair(const float* before, const float* after, float weight) {
    add_pair(a, before, after, weight);
    add_pair(b, before + kLanes, after + kLanes, weight);
    add_pair(c, before + 2 * kLanes, after + 2 * kLanes, weight);
    add_pair(d, before + 3 * kLanes, after + 3 * kLanes, weight);
  }
  void write(float* to) const {
    store(to, a);
    store(to + kLanes, b);
    store(to + 2 * kLanes, c);
    store(to + 3 * kLanes, d);
  }
  void write_less(const float* what, float* to) const {
    write_less(a, what, to);
    write_less(b, what + kLanes, to + kLanes);
    write_less(c, what + 2 * kLanes, to + 2 * kLanes);
    write_less(d, what + 3 * kLanes, to + 3 * kLanes);
  }

 private:
  static void add_pair(Lanes& sum, const float* before, const float* after, float weight) {
    Lanes x, y;
    load(x, before);
    load(y, after);
    sum += (x + y) * weight;
  }
  static void write_less(const Lanes& value, const float* what, float* to) {
    Lanes x;
    load(x, what);
    store(to, value - x);
  }
};

/// Copies `row` to the scratch buffer with its edge pixels repeated at both ends; returns the position of its first
/// pixel.
inline const float* pad(const BlurTask& task, const float* row) {
  float* const begin = task.padded + task.radius;
  __builtin_memcpy(begin, row, sizeof(float) * static_cast<unsigned>(task.width));
  for (int i = 1; i <= task.radius; ++i) begin[-i] = row[0];
  for (int i = 0; i < task.radius; ++i) begin[task.width + i] = row[task.width - 1];
  return begin;
}

inline void blur_along_row(const BlurTask& task, const float* row, float* out) {
  const float* const padded = pad(task, row);
  for (int x = 0; x < task.width; x += kBlock) {
    Block sum;
    sum.begin(padded + x, task.weights[0]);
    for (int i = 1; i <= task.radius; ++i) sum.add_pair(padded + x - i, padded + x + i, task.weights[i]);
    sum.write(out + x);
  }
}

/// Number of rows in the ring of horizontally blurred rows. It is the least possible, so that the ring fits the caches.
inline int ring_size(const BlurTask& task) { return 2 * task.radius + 1; }

inline float* ring_row(const BlurTask& task, int place) { return task.rows + static_cast<long>(place) * task.stride; }

inline void blur_across_rows(const BlurTask& task, int y) {
  const int size = ring_size(task), place = y % size;
  const float* const in = task.in + static_cast<long>(y) * task.stride;
  float* const out = task.out + static_cast<long>(y) * task.stride;
  float* const difference = task.difference == nullptr ? nullptr : task.difference + static_cast<long>(y) * task.stride;
  for (int x = 0; x < task.width; x += kBlock) {
    Block sum;
    sum.begin(ring_row(task, place) + x, task.weights[0]);
    int above = place, below = place;  // Beyond the image, both stay at its edge row
    for (int i = 1; i <= task.radius; ++i) {
      if (y - i >= 0) above = above == 0 ? size - 1 : above - 1;
      if (y + i < task.height) below = below + 1 == size ? 0 : below + 1;
      sum.add_pair(ring_row(task, above) + x, ring_row(task, below) + x, task.weights[i]);
    }
    sum.write(out + x);
    if (difference != nullptr) sum.write_less(in + x, difference + x);
  }
}

inline void blur_image(const BlurTask& task) {
  int next = 0;
  for (int y = 0; y < task.height; ++y) {
    for (; next < task.height && next <= y + task.radius; ++next)
      blur_along_row(task, task.in + static_cast<long>(next) * task.stride, ring_row(task, next % ring_size(task)));
    blur_across_rows(task, y);
  }
}

/// Returns one bit for each lane of `mask` that is set.
inline unsigned bits(const Words& mask) {
#if defined(__AVX2__)
  return static_cast<unsigned>(__builtin_ia32_movmskps256((Lanes)mask));
#elif defined(__SSE2__)
  return static_cast<unsigned>(__builtin_ia32_movmskps((Lanes)mask));
#elif defined(__ARM_NEON)
  return vaddvq_u32((uint32x4_t)(mask & Words{1, 2, 4, 8}));
#else
  unsigned result = 0;
  for (int i = 0; i < kLanes; ++i) result |= (static_cast<unsigned>(mask[i]) & 1U) << i;
  return result;
#endif
}

/// The largest and the smallest of the offered values, lane by lane.
struct Limits {
  Lanes high, low;

  void offer(const float* from) {
    Lanes value;
    load(value, from);
    high = value > high ? value : high;
    low = value < low ? value : low;
  }
  void offer_three(const float* middle) {
    offer(middle - 1);
    offer(middle);
    offer(middle + 1);
  }
};

inline unsigned extrema_at(const Neighbourhood& around, int x, float threshold) {
  Lanes value;
  load(value, around.rows[4] + x);
  const Words strong = (value > threshold) | (value < -threshold);
  if (bits(strong) == 0) return 0;
  Limits limits{value, value};
  for (int row = 3; row < 6; ++row) limits.offer_three(around.rows[row] + x);
  unsigned found = bits(strong & ((value >= limits.high) | (value <= limits.low)));
  if (found == 0) return 0;
  for (int row = 0; row < 9; row += row == 2 ? 4 : 1) limits.offer_three(around.rows[row] + x);
  const Words peak = (value > threshold) & (value >= limits.high), pit = (value < -threshold) & (value <= limits.low);
  return bits(peak | pit);
}

inline int find_extrema_in_row(const Neighbourhood& around, int first, int last, float threshold,
                               std::int32_t* columns) {
  int count = 0;
  for (int x = first; x < last; x += kLanes) {
    for (unsigned found = extrema_at(around, x, threshold); found != 0; found &= found - 1) {
      const int column = x + __builtin_ctz(found);
      if (column < last) columns[count++] = column;
    }
  }
  return count;
}

inline void scale_to_intensity(const std::uint16_t* values, int count, float* out) {
  for (int i = 0; i < count; i += kLanes) {
    Shorts shorts;
    __builtin_memcpy(&shorts, values + i, sizeof shorts);
    store(out + i, __builtin_convertvector(shorts, Lanes) * (1.0F / (255.0F * 256.0F)));
  }
}

inline const ScaleSpaceKernels& kernels() {
  static constexpr ScaleSpaceKernels kKernels{blur_image, find_extrema_in_row, scale_to_intensity};
  return kKernels;
}

}  // namespace
}  // namespace azimuth
