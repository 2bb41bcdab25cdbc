#pragma once
// rig.toml: what is fixed on the robot.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_result.hpp"
#include "settings/model_keys.hpp"
#include "settings/section.hpp"
#include "slam/estimator/rig.hpp"

namespace azimuth {

/// A rig as its file has it.
struct RigKeys {
  Rig rig;
  ModelKeys model;  ///< in place of rig.camera.model
};
RigKeys keys_of(const Rig& rig);

/// The tables of rig.toml, bound to `keys`, which must outlive them.
std::vector<Section> rig_sections(RigKeys& keys);

/// Reads the text of a rig.toml; `file` is what violations name. Every violation is reported, also a camera model
/// without a parameter it needs.
FileResult<Rig> read_rig(std::string_view text, const std::string& file);

/// Reads the file; one that cannot be read is a violation with the reason.
FileResult<Rig> read_rig_file(const std::filesystem::path& file);

/// The text of a rig.toml with every key that has a value, each with what it means: read_rig() gives the same rig back.
std::string rig_text(const Rig& rig);

}  // namespace azimuth
