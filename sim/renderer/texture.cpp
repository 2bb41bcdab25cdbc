#include "sim/renderer/texture.hpp"

#include <cassert>

namespace azimuth {

namespace {

Colour average(Colour a, Colour b, Colour c, Colour d) {
  const auto channel = [&](unsigned shift) {
    const auto of = [shift](Colour each) { return each >> shift & 0xFFU; };
    return (of(a) + of(b) + of(c) + of(d) + 2) / 4 << shift;
  };
  return channel(0) | channel(8) | channel(16);
}

std::vector<Colour> halved(const std::vector<Colour>& texels, std::size_t side) {
  std::vector<Colour> half;
  half.reserve(texels.size() / 4);
  for (std::size_t y = 0; y < side; y += 2) {
    for (std::size_t x = 0; x < side; x += 2) {
      const std::size_t at = y * side + x;
      half.push_back(average(texels[at], texels[at + 1], texels[at + side], texels[at + side + 1]));
    }
  }
  return half;
}

}  // namespace

Texture::Texture(std::vector<Colour> texels, double side_m) : side_m_(static_cast<float>(side_m)) {
  log2_side_ = static_cast<unsigned>(std::bit_width(texels.size()) - 1) / 2;
  assert(texels.size() == std::size_t{1} << (2 * log2_side_) && side_m > 0.0);
  texels_per_m_ = static_cast<float>(1U << log2_side_) / side_m_;
  levels_.push_back(std::move(texels));
  for (unsigned log2 = log2_side_; log2 > 0; --log2) levels_.push_back(halved(levels_.back(), std::size_t{1} << log2));
}

}  // namespace azimuth
