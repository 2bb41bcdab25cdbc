#pragma once
// The rig file rig.toml: the fixed properties of the robot.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_result.hpp"
#include "settings/section.hpp"
#include "slam/camera/camera_rig.hpp"
#include "slam/estimator/rig.hpp"

namespace azimuth {

/// The keys of the camera's model in the table [camera] of rig.toml: the model's name, and the parameters of all models
/// side by side. A parameter is absent if the file does not give it. The file may also give parameters
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

/// The rig in the form of its file.
struct RigKeys {
  Rig rig;
  ModelKeys model;  ///< replaces rig.camera.model
};
RigKeys keys_of(const Rig& rig);

/// The tables of rig.toml, bound to `keys`, which must outlive them.
std::vector<Section> rig_sections(RigKeys& keys);

/// Reads the text of a rig.toml. Violations name `file`. The function reports every violation, including a missing
/// parameter of the camera model.
FileResult<Rig> read_rig(std::string_view text, const std::string& file);

/// Reads the file. A file that cannot be read gives a violation with the reason.
FileResult<Rig> read_rig_file(const std::filesystem::path& file);

/// The text of a rig.toml with every key that has a value, each with its help. read_rig() gives the same rig back.
std::string rig_text(const Rig& rig);

}  // namespace azimuth
