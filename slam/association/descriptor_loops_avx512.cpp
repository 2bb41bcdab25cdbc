// Compiled with -mavx512f -mavx512vnni (CMakeLists.txt). Called only on processors with both.

#include "slam/association/descriptor_loops.hpp"

#if defined(__AVX512VNNI__)
#include <immintrin.h>

namespace azimuth::avx512 {
namespace {

/// Replaces std::array::begin(). This file calls nothing of the standard library: the linker might use a copy compiled
/// for this processor on others.
template <class Element, std::size_t Size>
inline const Element* begin(const std::array<Element, Size>& array) {
  return reinterpret_cast<const Element*>(&array);
}

inline __m512i load(const void* from) { return _mm512_load_si512(from); }

/// The instruction multiplies unsigned by signed bytes, so the query is given less 128: the sums are a.b - 128 sum(a).
inline __m512i add_products(__m512i sum, __m512i values, std::uint32_t centred) {
  return _mm512_dpbusd_epi32(sum, values, _mm512_set1_epi32(static_cast<int>(centred)));
}

/// Writes |a|^2 + |b|^2 - 2 a.b for sixteen lanes; returns one bit per lane, set if the value is below the bound.
inline std::uint32_t finish(const DescriptorBlock& block, std::int32_t query_norm2, __m512i sum, std::int32_t bound,
                            std::int32_t* out) {
  const __m512i product = _mm512_add_epi32(sum, _mm512_mullo_epi32(load(begin(block.sum)), _mm512_set1_epi32(128)));
  const __m512i norms = _mm512_add_epi32(load(begin(block.squared_norm)), _mm512_set1_epi32(query_norm2));
  const __m512i distance2 = _mm512_sub_epi32(norms, _mm512_add_epi32(product, product));
  _mm512_store_si512(out, distance2);
  return _mm512_cmplt_epi32_mask(distance2, _mm512_set1_epi32(bound));
}

}  // namespace

bool supported() { return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512vnni") != 0; }

void find_near(const DescriptorBlock& block, const DescriptorQuery* queries, const std::int32_t* bounds,
               NearLanes& out) {
  static_assert(DescriptorBlock::kLanes == 16 && kQueriesAtOnce == 4 && DescriptorQuery::kWords % 2 == 0);
  // Two sums per query: a single one would wait for its own latency.
  __m512i a0{}, a1{}, a2{}, a3{}, b0{}, b1{}, b2{}, b3{};
  const std::uint8_t* values = begin(block.values);
  for (std::size_t word = 0; word < DescriptorQuery::kWords; word += 2, values += 128) {
    const __m512i first = load(values), second = load(values + 64);
    a0 = add_products(a0, first, begin(queries[0].centred)[word]);
    a1 = add_products(a1, first, begin(queries[1].centred)[word]);
    a2 = add_products(a2, first, begin(queries[2].centred)[word]);
    a3 = add_products(a3, first, begin(queries[3].centred)[word]);
    b0 = add_products(b0, second, begin(queries[0].centred)[word + 1]);
    b1 = add_products(b1, second, begin(queries[1].centred)[word + 1]);
    b2 = add_products(b2, second, begin(queries[2].centred)[word + 1]);
    b3 = add_products(b3, second, begin(queries[3].centred)[word + 1]);
  }
  const auto write = [&](std::size_t q, __m512i a, __m512i b) {
    auto* const distance2 = reinterpret_cast<std::int32_t*>(&out.squared_distance) + 16 * q;
    reinterpret_cast<std::uint32_t*>(&out.near)[q] =
        finish(block, queries[q].squared_norm, _mm512_add_epi32(a, b), bounds[q], distance2);
  };
  write(0, a0, b0);
  write(1, a1, b1);
  write(2, a2, b2);
  write(3, a3, b3);
}

}  // namespace azimuth::avx512

#else

namespace azimuth::avx512 {
bool supported() { return false; }
void find_near(const DescriptorBlock& block, const DescriptorQuery* queries, const std::int32_t* bounds,
               NearLanes& out) {
  portable::find_near(block, queries, bounds, out);
}
}  // namespace azimuth::avx512

#endif
