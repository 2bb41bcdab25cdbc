#pragma once
// The parameters of a camera's model by their keys in rig.toml.

#include <array>
#include <string_view>
#include <variant>
#include <vector>

#include "slam/camera/model_rig.hpp"

namespace azimuth {

struct ModelParameter {
  std::string_view key;
  double* value;          ///< in the model
  bool is_needed = true;  ///< without it the model has no meaning
};

/// All of the model's own, of which it stays the owner.
std::vector<ModelParameter> parameters(ModelRig& model);

/// One of each model, without parameters; at the index that its kind has in ModelRig.
std::array<ModelRig, std::variant_size_v<ModelRig>> all_models();

}  // namespace azimuth
