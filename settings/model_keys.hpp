#pragma once
// The camera's model as rig.toml's table [camera] has it: a word, and the parameters of all models side by side.

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "settings/section.hpp"
#include "slam/camera/model_rig.hpp"

namespace azimuth {

/// What the file says; absent: it does not. Parameters of other models than the one that is named may stand there, too.
struct ModelKeys {
  std::size_t model = 0;  ///< its kind's index in ModelRig
  std::optional<double> a_px, b, c_px, d;
  std::optional<double> mirror_a_mm, mirror_b_mm, focal_length_px, horizon_radius_px;
  std::optional<double> polynomial_a0, polynomial_a1, polynomial_a2, polynomial_a3, polynomial_a4;
};

Key model_key(ModelKeys& keys);
std::vector<Key> parameter_keys(ModelKeys& keys);

/// The model with the parameters that are there.
ModelRig model_of(ModelKeys keys);
/// As a file would have it.
ModelKeys keys_of(ModelRig model);

/// Keys of [camera] without which the model has no meaning.
std::vector<std::string_view> needed_by(ModelRig model);

}  // namespace azimuth
