#pragma once
// The loops of descriptor_block.hpp for each kind of processor; only their dispatch and their tests include this. Code
// that is not for this processor must not be called.

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

namespace avx512 {  // with its instructions for 8-bit products
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
