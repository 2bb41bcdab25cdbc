#include "sim/renderer/texture.hpp"

#include <array>
#include <cassert>

#include "sim/world/random.hpp"

namespace azimuth {
namespace {

using Texels = std::vector<PackedColour>;

/// Smooth noise in [-1, 1] with a period of `side` texels: interpolated random values on grids of several cell sizes.
class Noise {
 public:
  Noise(std::size_t side, Random& random) : side_(side), values_(side * side, 0.0F) {
    float weight = 0.5F;
    for (std::size_t cells = 8; cells <= side; cells *= 4, weight *= 0.6F) add(cells, weight, random);
  }
  float at(std::size_t x, std::size_t y) const { return values_[y * side_ + x]; }

 private:
  void add(std::size_t cells, float weight, Random& random) {
    std::vector<float> grid(cells * cells);
    for (float& value : grid) value = weight * static_cast<float>(random.uniform(-1.0, 1.0));
    const std::size_t step = side_ / cells;
    const auto node = [&](std::size_t x, std::size_t y) { return grid[y % cells * cells + x % cells]; };
    for (std::size_t y = 0; y < side_; ++y) {
      for (std::size_t x = 0; x < side_; ++x) {
        const float fx = static_cast<float>(x % step) / static_cast<float>(step);
        const float fy = static_cast<float>(y % step) / static_cast<float>(step);
        const std::size_t left = x / step, top = y / step;
        values_[y * side_ + x] += std::lerp(std::lerp(node(left, top), node(left + 1, top), fx),
                                            std::lerp(node(left, top + 1), node(left + 1, top + 1), fx), fy);
      }
    }
  }

  std::size_t side_;
  std::vector<float> values_;
};

unsigned channel(float value) { return static_cast<unsigned>(std::clamp(value, 0.0F, 255.0F)); }

PackedColour shade(float red, float green, float blue, float brighter) {
  return colour(channel(red + brighter), channel(green + brighter), channel(blue + brighter));
}

PackedColour any_colour(Random& random) {
  const auto any = [&random] { return static_cast<unsigned>(random.uniform(10.0, 250.0)); };
  const unsigned red = any(), green = any(), blue = any();
  return colour(red, green, blue);
}

constexpr std::size_t kPosterSide = 128, kBorder = 4;

struct Box {
  std::size_t left, top, right, bottom;
};

Box any_box(Random& random) {
  const auto place = [&random] { return kBorder + random.index(kPosterSide - 2 * kBorder - 8); };
  const auto size = [&random] { return 4 + random.index(random.index(6) == 0 ? 60 : 24); };
  const std::size_t left = place(), top = place();
  const std::size_t width = size(), height = size();
  return {left, top, std::min(left + width, kPosterSide - kBorder), std::min(top + height, kPosterSide - kBorder)};
}

void fill_box(Texels& texels, const Box& box, PackedColour ink, bool ellipse) {
  const double half_width = 0.5 * static_cast<double>(box.right - box.left);
  const double half_height = 0.5 * static_cast<double>(box.bottom - box.top);
  for (std::size_t y = box.top; y < box.bottom; ++y) {
    for (std::size_t x = box.left; x < box.right; ++x) {
      const double dx = (static_cast<double>(x - box.left) + 0.5 - half_width) / half_width;
      const double dy = (static_cast<double>(y - box.top) + 0.5 - half_height) / half_height;
      if (!ellipse || dx * dx + dy * dy <= 1.0) texels[y * kPosterSide + x] = ink;
    }
  }
}

/// Prints a line of signs, each a 3 x 5 dot pattern, which resembles text from a few metres away.
void print_line(Texels& texels, PackedColour ink, Random& random) {
  const std::size_t dot = 1 + random.index(3);
  const std::size_t top = kBorder + random.index(kPosterSide - 2 * kBorder - 5 * dot);
  for (std::size_t left = kBorder + dot; left + 4 * dot < kPosterSide - kBorder; left += 4 * dot) {
    const std::size_t sign = random.index(1U << 15U);
    for (std::size_t bit = 0; bit < 15; ++bit) {
      if ((sign >> bit & 1U) == 0) continue;
      const std::size_t x = left + bit % 3 * dot, y = top + bit / 3 * dot;
      fill_box(texels, {x, y, x + dot, y + dot}, ink, false);
    }
  }
}

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

Texture floor_texture(std::uint64_t seed) {
  constexpr std::size_t kSide = 512, kTile = 64, kJoint = 2;  // 4 m in tiles of 0.5 m
  Random random(seed, RandomPurpose::scene);
  const Noise noise(kSide, random);
  std::array<float, (kSide / kTile) * (kSide / kTile)> tile_brightness{};
  for (float& each : tile_brightness) each = static_cast<float>(random.uniform(-6.0, 6.0));
  Texels texels;
  for (std::size_t y = 0; y < kSide; ++y) {
    for (std::size_t x = 0; x < kSide; ++x) {
      const std::size_t column = x / kTile, row = y / kTile;
      const bool joint = x % kTile < kJoint || y % kTile < kJoint;
      const float tile = tile_brightness[row * (kSide / kTile) + column] + ((column + row) % 2 == 0 ? 9.0F : -9.0F);
      texels.push_back(shade(108, 103, 96, 22 * noise.at(x, y) + (joint ? -35.0F : tile)));
    }
  }
  return {std::move(texels), 4.0};
}

Texture plaster_texture(std::uint64_t seed) {
  constexpr std::size_t kSide = 256;
  Random random(seed, RandomPurpose::scene);
  const Noise noise(kSide, random);
  Texels texels;
  for (std::size_t y = 0; y < kSide; ++y) {
    for (std::size_t x = 0; x < kSide; ++x) texels.push_back(shade(196, 198, 196, 12 * noise.at(x, y)));
  }
  return {std::move(texels), 5.0};
}

Texture poster_texture(std::uint64_t seed, double side_m) {
  constexpr int kShapes = 30, kLines = 3;
  Random random(seed, RandomPurpose::scene);
  Texels texels(kPosterSide * kPosterSide, any_colour(random));
  fill_box(texels, {kBorder, kBorder, kPosterSide - kBorder, kPosterSide - kBorder}, any_colour(random), false);
  for (int i = 0; i < kShapes; ++i) {
    const Box box = any_box(random);
    const PackedColour ink = any_colour(random);
    fill_box(texels, box, ink, random.chance(0.4));
  }
  for (int i = 0; i < kLines; ++i) {
    const PackedColour ink = any_colour(random);
    print_line(texels, ink, random);
  }
  return {std::move(texels), side_m};
}

}  // namespace azimuth
