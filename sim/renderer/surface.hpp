#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "sim/renderer/colour.hpp"
#include "sim/renderer/texture.hpp"

namespace azimuth {

/// A rectangle on a surface: a picture, or a light of one colour.
struct Decal {
  float left_m = 0.0F, low_m = 0.0F, right_m = 0.0F, high_m = 0.0F;
  std::optional<Texture> picture;
  PackedColour light = 0;  ///< Used if there is no picture
};

/// One flat side of the room with its decals, in coordinates of its own: `across` and `up`, in metres.
///
/// Thread contract: reentrant.
class Surface {
 public:
  /// `brightness` (256: full) applies to the ground and to pictures; lights are not dimmed.
  Surface(Texture ground, std::vector<Decal> decals, unsigned brightness);

  /// The colour of a pixel that covers a rectangle of this size about the point.
  PackedColour at(float across_m, float up_m, float width_m, float height_m) const;

 private:
  static constexpr float kCell_m = 0.25F;

  void index_decals();
  std::size_t cell(float across_m, float up_m) const;

  Texture ground_;
  std::vector<Decal> decals_;
  unsigned brightness_;
  // A grid over all decals: the decals of cell i are places_[starts_[i] .. starts_[i + 1]).
  float left_m_ = 0.0F, low_m_ = 0.0F;
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<std::uint32_t> starts_, places_;
};

}  // namespace azimuth
