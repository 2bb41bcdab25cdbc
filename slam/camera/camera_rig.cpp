#include "slam/camera/camera_rig.hpp"

#include <cstddef>
#include <utility>

namespace azimuth {

namespace {

struct ParametersOf {
  using Parameters = std::vector<ModelParameter>;

  Parameters operator()(BearingsRig&) const { return {}; }
  Parameters operator()(RadialRig&) const { return {}; }
  Parameters operator()(HyperbolicMirrorRig& mirror) const {
    return {{"mirror_a_mm", &mirror.a_mm}, {"mirror_b_mm", &mirror.b_mm}, {"focal_length_px", &mirror.focal_length_px}};
  }
  Parameters operator()(ParabolicMirrorRig& mirror) const { return {{"horizon_radius_px", &mirror.horizon_radius_px}}; }
  Parameters operator()(PajdlaRig& lens) const {
    return {{"a_px", &lens.a_px}, {"b", &lens.b}, {"c_px", &lens.c_px}, {"d", &lens.d}};
  }
  Parameters operator()(EquidistantRig& lens) const { return {{"focal_length_px", &lens.focal_length_px}}; }
  Parameters operator()(PolynomialRig& lens) const {
    auto& [a0, a1, a2, a3, a4] = lens.a;
    return {{"polynomial_a0", &a0},
            {"polynomial_a1", &a1, false},
            {"polynomial_a2", &a2},
            {"polynomial_a3", &a3},
            {"polynomial_a4", &a4}};
  }
};

template <std::size_t... Index>
std::array<ModelRig, sizeof...(Index)> one_of_each(std::index_sequence<Index...> /*all*/) {
  return {ModelRig(std::in_place_index<Index>)...};
}

}  // namespace

std::vector<ModelParameter> parameters(ModelRig& model) { return std::visit(ParametersOf{}, model); }

std::array<ModelRig, std::variant_size_v<ModelRig>> all_models() {
  return one_of_each(std::make_index_sequence<std::variant_size_v<ModelRig>>());
}

}  // namespace azimuth
