#pragma once
// The camera's model in the table [camera] of rig.toml: the model's name, and the parameters of all models side by
// side.

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "settings/section.hpp"
#include "slam/camera/camera_rig.hpp"

namespace azimuth {

/// The model's keys in the file. A parameter is absent if the file does not give it. The file may also give parameters
/// of models other than the named one.
struct ModelKeys {
  std::size_t model = 0;  ///< index of the model's type in ModelRig
  std::optional<double> a_px, b, c_px, d;
  std::optional<double> mirror_a_mm, mirror_b_mm, focal_length_px, horizon_radius_px;
  std::optional<double> polynomial_a0, polynomial_a1, polynomial_a2, polynomial_a3, polynomial_a4;
};

Key model_key(ModelKeys& keys);
std::vector<Key> parameter_keys(ModelKeys& keys);

/// Returns the model with the parameters that `keys` has.
ModelRig model_of(ModelKeys keys);
/// Returns the keys from which model_of() makes the same model.
ModelKeys keys_of(ModelRig model);

/// The keys of [camera] that the model requires.
std::vector<std::string_view> needed_by(ModelRig model);

}  // namespace azimuth
