#include "sim/renderer/texture.hpp"

#include <cassert>

namespace azimuth {

namespace {

PackedColour average(PackedColour a, PackedColour b, PackedColour c, PackedColour d) {
  const auto channel = [&](unsigned shift) {
    const auto of = [shift](PackedColour each) { return each >> shift & 0xFFU; };
    return (of(a) + of(b) + of(c) + of(d) + 2) / 4 << shift;
  };
  return channel(0) | channel(8) | channel(16);
}

std::vector<PackedColour> halved(const std::vector<PackedColour>& texels, std::size_t side) {
  std::vector<PackedColour> half;
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

Texture::Texture(std::vector<PackedColour> texels, double side_m) : side_m_(static_cast<float>(side_m)) {
  auto shift = static_cast<unsigned>(std::bit_width(texels.size()) - 1) / 2;
  assert(texels.size() == std::size_t{1} << (2 * shift) && side_m > 0.0);
  texels_per_m_ = static_cast<float>(1U << shift) / side_m_;
  while (true) {
    const std::size_t side = std::size_t{1} << shift;
    std::vector<PackedColour> half = side > 1 ? halved(texels, side) : std::vector<PackedColour>{};
    const auto mask = static_cast<unsigned>(side - 1);
    levels_.push_back({std::move(texels), 256.0F * static_cast<float>(side) / side_m_, shift, mask});
    if (side == 1) return;
    texels = std::move(half);
    --shift;
  }
}

}  // namespace azimuth
