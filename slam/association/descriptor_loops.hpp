#pragma once
// The loops of descriptor_block.hpp for each kind of processor, for dispatch and tests only. A function must be called
// only if its supported() returns true.

#include "slam/association/descriptor_block.hpp"

namespace azimuth {

struct DescriptorLoops {
  decltype(&find_near) find;
  decltype(&dot_product) dot;
};

namespace portable {
void find_near(const DescriptorBlock& block, const DescriptorQuery* queries, const std::int32_t* bounds,
               NearLanes& out);
std::int32_t dot_product(const Descriptor& a, const Descriptor& b);
}  // namespace portable

namespace avx2 {
bool supported();
void find_near(const DescriptorBlock& block, const DescriptorQuery* queries, const std::int32_t* bounds,
               NearLanes& out);
std::int32_t dot_product(const Descriptor& a, const Descriptor& b);
}  // namespace avx2

namespace avx512 {  // requires the instructions for 8-bit products (VNNI)
bool supported();
void find_near(const DescriptorBlock& block, const DescriptorQuery* queries, const std::int32_t* bounds,
               NearLanes& out);
}  // namespace avx512

namespace neon {
bool supported();
void find_near(const DescriptorBlock& block, const DescriptorQuery* queries, const std::int32_t* bounds,
               NearLanes& out);
std::int32_t dot_product(const Descriptor& a, const Descriptor& b);
}  // namespace neon

}  // namespace azimuth
