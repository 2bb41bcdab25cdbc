#include "settings/model_keys.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "slam/camera/camera_rig.hpp"

namespace azimuth {
namespace {

constexpr double kMaxModelPixels = 1e5;

/// The member that the key `name` fills.
std::optional<double>& member(std::vector<Key>& keys, std::string_view name) {
  const auto key = std::ranges::find(keys, name, &Key::name);
  assert(key != keys.end());
  return *std::get<std::optional<double>*>(key->target);
}

}  // namespace

Key model_key(ModelKeys& keys) {
  std::vector<std::pair<std::string_view, std::size_t>> words;
  for (const ModelRig& model : all_models()) words.emplace_back(name(model), model.index());
  return choice<std::size_t>(
      "model", keys.model, std::move(words),
      "Model of the camera. bearings: directions come ready made; radial: only azimuths are known; hyperbolic_mirror "
      "and parabolic_mirror: mirrors; pajdla, equidistant and polynomial: fisheyes.");
}

std::vector<Key> parameter_keys(ModelKeys& keys) {
  return {
      {"a_px", &keys.a_px, "Coefficient a of pajdla: r = a tan(theta/b) + c sin(theta/d).", from_to(-1e9, 1e9)},
      {"b", &keys.b, "Coefficient b of pajdla.", above_to(0, 1e6)},
      {"c_px", &keys.c_px, "Coefficient c of pajdla.", from_to(-1e9, 1e9)},
      {"d", &keys.d, "Coefficient d of pajdla.", above_to(0, 1e6)},
      {"mirror_a_mm", &keys.mirror_a_mm, "Semi-axis a of hyperbolic_mirror: z^2/a^2 - r^2/b^2 = 1.", above_to(0, 1e4)},
      {"mirror_b_mm", &keys.mirror_b_mm, "Semi-axis b of hyperbolic_mirror.", above_to(0, 1e4)},
      {"focal_length_px", &keys.focal_length_px,
       "Focal length of the camera of hyperbolic_mirror; for equidistant, pixels per radian.",
       above_to(0, kMaxModelPixels)},
      {"horizon_radius_px", &keys.horizon_radius_px,
       "Radius h of the horizon of parabolic_mirror: r = h tan(pi/4 + elevation/2).", above_to(0, kMaxModelPixels)},
      {"polynomial_a0", &keys.polynomial_a0,
       "Coefficient a0 of polynomial (OCamCalib): the angle from the axis is atan2(r, -(a0 + a1 r + ... + a4 r^4)), r "
       "in pixels.",
       from_to(-kMaxModelPixels, -1)},
      {"polynomial_a1", &keys.polynomial_a1, "Coefficient a1 of polynomial, usually 0.", from_to(-1e3, 1e3)},
      {"polynomial_a2", &keys.polynomial_a2, "Coefficient a2 of polynomial.", from_to(-1e3, 1e3)},
      {"polynomial_a3", &keys.polynomial_a3, "Coefficient a3 of polynomial.", from_to(-1e3, 1e3)},
      {"polynomial_a4", &keys.polynomial_a4, "Coefficient a4 of polynomial.", from_to(-1e3, 1e3)},
  };
}

ModelRig model_of(ModelKeys keys) {
  std::vector<Key> all = parameter_keys(keys);
  ModelRig model = all_models().at(keys.model);
  for (const ModelParameter& parameter : parameters(model))
    *parameter.value = member(all, parameter.key).value_or(*parameter.value);
  return model;
}

ModelKeys keys_of(ModelRig model) {
  ModelKeys keys;
  keys.model = model.index();
  std::vector<Key> all = parameter_keys(keys);
  for (const ModelParameter& parameter : parameters(model))
    if (!std::isnan(*parameter.value)) member(all, parameter.key) = *parameter.value;
  return keys;
}

std::vector<std::string_view> needed_by(ModelRig model) {
  std::vector<std::string_view> keys;
  if (takes_images(model)) keys.emplace_back("centre_px");
  for (const ModelParameter& parameter : parameters(model))
    if (parameter.is_needed) keys.push_back(parameter.key);
  if (looks_up(model)) keys.emplace_back("theta_max_rad");
  return keys;
}

}  // namespace azimuth
