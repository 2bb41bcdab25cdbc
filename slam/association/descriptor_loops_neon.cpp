// For arm64; every arm64 processor that runs Linux has these instructions.

#include "slam/association/descriptor_loops.hpp"

#if defined(__ARM_NEON)
#include <arm_neon.h>

namespace azimuth::neon {
namespace {

/// The query's four values in every lane. They are stored less 128, so their highest bits are inverted back.
inline uint8x16_t in_all_lanes(std::uint32_t centred) {
  return vreinterpretq_u8_u32(vdupq_n_u32(centred ^ 0x80808080U));
}

/// Adds the products for four lanes of four adjacent values each.
inline uint32x4_t add_products(uint32x4_t sum, uint8x16_t values, uint8x16_t query) {
  const uint16x8_t first = vmull_u8(vget_low_u8(values), vget_low_u8(query)), second = vmull_high_u8(values, query);
  return vaddq_u32(sum, vpaddq_u32(vpaddlq_u16(first), vpaddlq_u16(second)));
}

/// Writes |a|^2 + |b|^2 - 2 a.b for four lanes; returns one bit per lane, set if the value is below the bound.
inline std::uint32_t finish(const std::int32_t* squared_norms, std::int32_t query_norm2, uint32x4_t product,
                            std::int32_t bound, std::int32_t* out) {
  const int32x4_t norms = vaddq_s32(vld1q_s32(squared_norms), vdupq_n_s32(query_norm2));
  const int32x4_t distance2 = vsubq_s32(norms, vshlq_n_s32(vreinterpretq_s32_u32(product), 1));
  vst1q_s32(out, distance2);
  return vaddvq_u32(vandq_u32(vcltq_s32(distance2, vdupq_n_s32(bound)), uint32x4_t{1, 2, 4, 8}));
}

}  // namespace

bool supported() { return true; }

void find_near(const DescriptorBlock& block, const DescriptorQuery* queries, const std::int32_t* bounds,
               NearLanes& out) {
  static_assert(DescriptorBlock::kLanes == 16);
  for (std::size_t q = 0; q < kQueriesAtOnce; ++q) {
    uint32x4_t a{}, b{}, c{}, d{};  // four lanes each
    const std::uint8_t* values = block.values.data();
    for (std::size_t word = 0; word < DescriptorQuery::kWords; ++word, values += 64) {
      const uint8x16_t query = in_all_lanes(queries[q].centred[word]);
      a = add_products(a, vld1q_u8(values), query);
      b = add_products(b, vld1q_u8(values + 16), query);
      c = add_products(c, vld1q_u8(values + 32), query);
      d = add_products(d, vld1q_u8(values + 48), query);
    }
    const std::int32_t norm2 = queries[q].squared_norm;
    const std::int32_t* const norms = block.squared_norm.data();
    std::int32_t* const distance2 = out.squared_distance[q].data();
    out.near[q] = finish(norms, norm2, a, bounds[q], distance2) |
                  finish(norms + 4, norm2, b, bounds[q], distance2 + 4) << 4U |
                  finish(norms + 8, norm2, c, bounds[q], distance2 + 8) << 8U |
                  finish(norms + 12, norm2, d, bounds[q], distance2 + 12) << 12U;
  }
}

std::int32_t dot_product(const Descriptor& a, const Descriptor& b) {
  uint32x4_t sum{};
  for (std::size_t i = 0; i < DescriptorBlock::kValues; i += 16)
    sum = add_products(sum, vld1q_u8(a.values.data() + i), vld1q_u8(b.values.data() + i));
  return static_cast<std::int32_t>(vaddvq_u32(sum));
}

}  // namespace azimuth::neon

#else

namespace azimuth::neon {
bool supported() { return false; }
void find_near(const DescriptorBlock& block, const DescriptorQuery* queries, const std::int32_t* bounds,
               NearLanes& out) {
  portable::find_near(block, queries, bounds, out);
}
std::int32_t dot_product(const Descriptor& a, const Descriptor& b) { return portable::dot_product(a, b); }
}  // namespace azimuth::neon

#endif
