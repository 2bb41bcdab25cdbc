// Compiled with -mavx2 (CMakeLists.txt). Called only on processors with AVX2.

#include "slam/association/descriptor_loops.hpp"

#if defined(__AVX2__)
#include <immintrin.h>

namespace azimuth::avx2 {
namespace {

/// Replaces std::array::begin(). This file calls nothing of the standard library: the linker might use a copy compiled
/// for this processor on others.
template <class Element, std::size_t Size>
inline const Element* begin(const std::array<Element, Size>& array) {
  return reinterpret_cast<const Element*>(&array);
}

inline __m256i load(const void* from) { return _mm256_load_si256(static_cast<const __m256i*>(from)); }
inline __m256i in_all_lanes(std::uint32_t word) { return _mm256_set1_epi32(static_cast<int>(word)); }

/// Values of eight lanes, four per lane, as two pairs of 16-bit numbers.
struct EightLanes {
  __m256i even, odd;
  explicit EightLanes(const std::uint8_t* values) {
    const __m256i bytes = load(values);
    even = _mm256_and_si256(bytes, _mm256_set1_epi16(0xff));
    odd = _mm256_srli_epi16(bytes, 8);
  }
};

inline __m256i add_products(__m256i sum, const EightLanes& lanes, __m256i even, __m256i odd) {
  sum = _mm256_add_epi32(sum, _mm256_madd_epi16(lanes.even, even));
  return _mm256_add_epi32(sum, _mm256_madd_epi16(lanes.odd, odd));
}

/// Writes |a|^2 + |b|^2 - 2 a.b for eight lanes; returns one bit per lane, set if the value is below the bound.
inline std::uint32_t finish(const std::int32_t* squared_norms, std::int32_t query_norm2, __m256i product,
                            std::int32_t bound, std::int32_t* out) {
  const __m256i norms = _mm256_add_epi32(load(squared_norms), _mm256_set1_epi32(query_norm2));
  const __m256i distance2 = _mm256_sub_epi32(norms, _mm256_slli_epi32(product, 1));
  _mm256_store_si256(reinterpret_cast<__m256i*>(out), distance2);
  const __m256i near = _mm256_cmpgt_epi32(_mm256_set1_epi32(bound), distance2);
  return static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(near)));
}

}  // namespace

bool supported() { return __builtin_cpu_supports("avx2") != 0; }

void find_near(const DescriptorBlock& block, const DescriptorQuery* queries, const std::int32_t* bounds,
               NearLanes& out) {
  static_assert(DescriptorBlock::kLanes == 16 && kQueriesAtOnce == 4);
  // Separate variables instead of arrays: the sums must stay in registers at any level of optimisation.
  __m256i a0{}, a1{}, a2{}, a3{};  // lanes 0 to 7 of each query
  __m256i b0{}, b1{}, b2{}, b3{};  // lanes 8 to 15
  const std::uint8_t* values = begin(block.values);
  for (std::size_t word = 0; word < DescriptorQuery::kWords; ++word, values += 64) {
    const EightLanes first(values), second(values + 32);
    const auto step = [&](const DescriptorQuery& query, __m256i& a, __m256i& b) {
      const __m256i even = in_all_lanes(begin(query.even)[word]), odd = in_all_lanes(begin(query.odd)[word]);
      a = add_products(a, first, even, odd);
      b = add_products(b, second, even, odd);
    };
    step(queries[0], a0, b0);
    step(queries[1], a1, b1);
    step(queries[2], a2, b2);
    step(queries[3], a3, b3);
  }
  const auto write = [&](std::size_t q, __m256i a, __m256i b) {
    const std::int32_t norm2 = queries[q].squared_norm;
    auto* const distance2 = reinterpret_cast<std::int32_t*>(&out.squared_distance) + 16 * q;
    const std::int32_t* const norms = begin(block.squared_norm);
    reinterpret_cast<std::uint32_t*>(&out.near)[q] =
        finish(norms, norm2, a, bounds[q], distance2) | finish(norms + 8, norm2, b, bounds[q], distance2 + 8) << 8U;
  };
  write(0, a0, b0);
  write(1, a1, b1);
  write(2, a2, b2);
  write(3, a3, b3);
}

std::int32_t dot_product(const Descriptor& a, const Descriptor& b) {
  __m256i sum{};
  for (std::size_t i = 0; i < DescriptorBlock::kValues; i += 32) {
    const EightLanes of_a(begin(a.values) + i), of_b(begin(b.values) + i);
    sum = add_products(sum, of_a, of_b.even, of_b.odd);
  }
  __m128i rest = _mm_add_epi32(_mm256_castsi256_si128(sum), _mm256_extracti128_si256(sum, 1));
  rest = _mm_add_epi32(rest, _mm_shuffle_epi32(rest, 0x4e));
  return _mm_cvtsi128_si32(_mm_add_epi32(rest, _mm_shuffle_epi32(rest, 0xb1)));
}

}  // namespace azimuth::avx2

#else

namespace azimuth::avx2 {
bool supported() { return false; }
void find_near(const DescriptorBlock& block, const DescriptorQuery* queries, const std::int32_t* bounds,
               NearLanes& out) {
  portable::find_near(block, queries, bounds, out);
}
std::int32_t dot_product(const Descriptor& a, const Descriptor& b) { return portable::dot_product(a, b); }
}  // namespace azimuth::avx2

#endif
