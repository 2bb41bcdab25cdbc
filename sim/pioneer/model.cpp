#include "sim/pioneer/model.hpp"

#include <algorithm>
#include <array>

namespace azimuth::sim {
namespace {

struct Variant {
  std::string_view subclass;
  double mm_per_unit;
  double rad_per_s_per_mm_per_s;  ///< DiffConvFactor: turn rate over half the difference of the wheels' speeds
  int position_bits;
};

// The "-sh" controllers (ARCOS) count 16 bits, the older ones (P2OS) count 15.
constexpr std::array kVariants{
    Variant{"p3dx-sh", 1.0, 0.0056, 16},
    Variant{"p3at-sh", 1.0, 0.0034, 16},
    Variant{"p3dx", 0.485, 0.0056, 15},
    Variant{"p3at", 0.465, 0.0034, 15},
};

}  // namespace

std::optional<PioneerModel> pioneer_model(std::string_view subclass) {
  const auto variant = std::ranges::find(kVariants, subclass, &Variant::subclass);
  if (variant == kVariants.end()) return std::nullopt;
  PioneerModel model;
  model.subclass = subclass;
  model.mm_per_unit = variant->mm_per_unit;
  model.track_mm = 2.0 / variant->rad_per_s_per_mm_per_s;
  model.position_bits = variant->position_bits;
  return model;
}

std::string known_subclasses() {
  std::string names;
  for (const Variant& variant : kVariants) names += (names.empty() ? "" : ", ") + std::string(variant.subclass);
  return names;
}

}  // namespace azimuth::sim
