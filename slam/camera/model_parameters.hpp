#pragma once
// The parameters of a camera model, by their keys in rig.toml.

#include <array>
#include <string_view>
#include <variant>
#include <vector>

#include "slam/camera/model_rig.hpp"

namespace azimuth {

struct ModelParameter {
  std::string_view key;
  double* value;          ///< Points into the model
  bool is_needed = true;  ///< Whether the model is undefined without this parameter
};

/// All parameters of `model`, as pointers into it.
std::vector<ModelParameter> parameters(ModelRig& model);

/// One default-constructed model of each kind, at its index in ModelRig.
std::array<ModelRig, std::variant_size_v<ModelRig>> all_models();

}  // namespace azimuth
