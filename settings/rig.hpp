#pragma once
// The rig file rig.toml: the fixed properties of the robot.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_result.hpp"
#include "settings/model_keys.hpp"
#include "settings/section.hpp"
#include "slam/estimator/rig.hpp"

namespace azimuth {

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
