#include "sim/renderer/surface.hpp"

#include <algorithm>

namespace azimuth {

namespace {

constexpr float kMargin_m = 0.5F;  // Around each decal, for pixels that cover a part of it
constexpr std::size_t kOutside = std::numeric_limits<std::size_t>::max();

/// The share of an interval of length `width` about `at` that lies between `low` and `high`. The width is limited to
/// the margin on either side.
float covered(float at, float width, float low, float high) {
  width = std::min(width, 2.0F * kMargin_m);
  const float inside = std::min(high, at + 0.5F * width) - std::max(low, at - 0.5F * width);
  return std::max(inside, 0.0F) / width;
}

}  // namespace

Surface::Surface(Texture ground, std::vector<Decal> decals, unsigned brightness)
    : ground_(std::move(ground)), decals_(std::move(decals)), brightness_(brightness) {
  if (!decals_.empty()) index_decals();
}

void Surface::index_decals() {
  float right_m = std::numeric_limits<float>::lowest(), high_m = right_m;
  left_m_ = low_m_ = std::numeric_limits<float>::max();
  for (const Decal& decal : decals_) {
    left_m_ = std::min(left_m_, decal.left_m - kMargin_m);
    low_m_ = std::min(low_m_, decal.low_m - kMargin_m);
    right_m = std::max(right_m, decal.right_m + kMargin_m);
    high_m = std::max(high_m, decal.high_m + kMargin_m);
  }
  columns_ = static_cast<std::size_t>((right_m - left_m_) / kCell_m) + 1;
  rows_ = static_cast<std::size_t>((high_m - low_m_) / kCell_m) + 1;
  const auto place = [](float at, float low) { return static_cast<std::size_t>((at - low) / kCell_m); };
  std::vector<std::vector<std::uint32_t>> cells(columns_ * rows_);
  for (std::uint32_t i = 0; i < decals_.size(); ++i) {
    const Decal& decal = decals_[i];
    for (std::size_t y = place(decal.low_m - kMargin_m, low_m_); y <= place(decal.high_m + kMargin_m, low_m_); ++y) {
      for (std::size_t x = place(decal.left_m - kMargin_m, left_m_); x <= place(decal.right_m + kMargin_m, left_m_);
           ++x) {
        cells[y * columns_ + x].push_back(i);
      }
    }
  }
  starts_.push_back(0);
  for (const std::vector<std::uint32_t>& each : cells) {
    places_.insert(places_.end(), each.begin(), each.end());
    starts_.push_back(static_cast<std::uint32_t>(places_.size()));
  }
}

std::size_t Surface::cell(float across_m, float up_m) const {
  const float x = (across_m - left_m_) / kCell_m, y = (up_m - low_m_) / kCell_m;
  if (!(x >= 0.0F && y >= 0.0F && x < static_cast<float>(columns_) && y < static_cast<float>(rows_))) return kOutside;
  return static_cast<std::size_t>(y) * columns_ + static_cast<std::size_t>(x);
}

PackedColour Surface::at(float across_m, float up_m, float width_m, float height_m) const {
  const float footprint_m = std::sqrt(width_m * height_m);
  PackedColour seen = dim(ground_.at(across_m, up_m, ground_.level(footprint_m)), brightness_);
  const std::size_t here = cell(across_m, up_m);
  if (here == kOutside) return seen;
  for (std::uint32_t i = starts_[here]; i < starts_[here + 1]; ++i) {
    const Decal& decal = decals_[places_[i]];
    const float part =
        covered(across_m, width_m, decal.left_m, decal.right_m) * covered(up_m, height_m, decal.low_m, decal.high_m);
    if (part <= 0.0F) continue;
    const PackedColour face =
        decal.picture
            ? dim(decal.picture->at(across_m - decal.left_m, decal.high_m - up_m, decal.picture->level(footprint_m)),
                  brightness_)
            : decal.light;
    seen = mix(seen, face, fraction256(part));
  }
  return seen;
}

}  // namespace azimuth
