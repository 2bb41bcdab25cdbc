#include "slam/association/descriptor_block.hpp"

#include <numeric>

#include "slam/association/descriptor_loops.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kLanes = DescriptorBlock::kLanes;

std::size_t place(std::size_t lane, std::size_t value) { return value / 4 * 4 * kLanes + 4 * lane + value % 4; }

std::int32_t sum_of(const Descriptor& descriptor) {
  return std::accumulate(descriptor.values.begin(), descriptor.values.end(), 0);
}

const DescriptorLoops& loops() {
  static const DescriptorLoops chosen = [] {
    if (avx512::supported()) return DescriptorLoops{avx512::find_near, avx2::dot_product};
    if (avx2::supported()) return DescriptorLoops{avx2::find_near, avx2::dot_product};
    if (neon::supported()) return DescriptorLoops{neon::find_near, neon::dot_product};
    return DescriptorLoops{portable::find_near, portable::dot_product};
  }();
  return chosen;
}

}  // namespace

void DescriptorBlock::set(std::size_t lane, const Descriptor& descriptor) {
  for (std::size_t value = 0; value < kValues; ++value) values[place(lane, value)] = descriptor.values[value];
  sum[lane] = sum_of(descriptor);
  squared_norm[lane] = dot_product(descriptor, descriptor);
}

Descriptor DescriptorBlock::get(std::size_t lane) const {
  Descriptor descriptor;
  for (std::size_t value = 0; value < kValues; ++value) descriptor.values[value] = values[place(lane, value)];
  return descriptor;
}

DescriptorQuery::DescriptorQuery(const Descriptor& descriptor) : squared_norm(dot_product(descriptor, descriptor)) {
  for (std::size_t word = 0; word < kWords; ++word) {
    const std::uint8_t* const four = &descriptor.values[4 * word];
    even[word] = four[0] | static_cast<std::uint32_t>(four[2]) << 16U;
    odd[word] = four[1] | static_cast<std::uint32_t>(four[3]) << 16U;
    for (unsigned i = 0; i < 4; ++i)  // v - 128 as a byte is v with its highest bit inverted
      centred[word] |= static_cast<std::uint32_t>(four[i] ^ 0x80U) << 8U * i;
  }
}

void find_near(const DescriptorBlock& block, const DescriptorQuery* queries, const std::int32_t* bounds,
               NearLanes& out) {
  loops().find(block, queries, bounds, out);
}

std::int32_t dot_product(const Descriptor& a, const Descriptor& b) { return loops().dot(a, b); }

namespace portable {
namespace {

std::int32_t low(std::uint32_t word) { return static_cast<std::int32_t>(word & 0xffffU); }
std::int32_t high(std::uint32_t word) { return static_cast<std::int32_t>(word >> 16U); }

}  // namespace

void find_near(const DescriptorBlock& block, const DescriptorQuery* queries, const std::int32_t* bounds,
               NearLanes& out) {
  for (std::size_t q = 0; q < kQueriesAtOnce; ++q) {
    auto& distance2 = out.squared_distance[q];
    distance2.fill(0);
    for (std::size_t word = 0; word < DescriptorQuery::kWords; ++word) {
      const std::uint8_t* const values = &block.values[word * 4 * kLanes];
      const std::uint32_t even = queries[q].even[word], odd = queries[q].odd[word];
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        distance2[lane] += values[4 * lane] * low(even) + values[4 * lane + 1] * low(odd) +
                           values[4 * lane + 2] * high(even) + values[4 * lane + 3] * high(odd);
    }
    out.near[q] = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      distance2[lane] = block.squared_norm[lane] + queries[q].squared_norm - 2 * distance2[lane];
      out.near[q] |= (distance2[lane] < bounds[q] ? 1U : 0U) << lane;
    }
  }
}

std::int32_t dot_product(const Descriptor& a, const Descriptor& b) {
  return std::transform_reduce(a.values.begin(), a.values.end(), b.values.begin(), std::int32_t{0});
}

}  // namespace portable
}  // namespace azimuth
