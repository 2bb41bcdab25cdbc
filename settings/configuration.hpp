#pragma once
// The configuration file azimuth.toml: the settings of the estimator, without the fixed properties of the robot, which
// rig.toml has. The daemon adds tables of its own.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/file_result.hpp"
#include "settings/section.hpp"
#include "slam/ceiling/lamp_ekf_settings.hpp"
#include "slam/estimator/estimator_stage.hpp"
#include "slam/estimator/health_settings.hpp"
#include "slam/estimator/map_start.hpp"
#include "slam/fastslam/fastslam_settings.hpp"
#include "slam/hindsight/hindsight_settings.hpp"
#include "slam/localisation/relocalisation_settings.hpp"
#include "slam/perception/make_perception.hpp"
#include "slam/planar/ekf_settings.hpp"

namespace azimuth {

/// The set of values for the filters' and SIFT's settings that no key in the file gives.
enum class Preset : std::uint8_t {
  recommended,  ///< `preset = "default"`: the values that measured best
  paper,        ///< the values that the two papers print
  paper_7deg    ///< like `paper`, with the other parallax that the FastSLAM paper prints
};

enum class EstimatorKind : std::uint8_t {
  by_rig,  ///< chosen_estimator() chooses the kind by the rig
  ekf,
  lamp_ekf,
  fastslam,
  smoother
};

/// All kinds with their names in files, in the order of the enumeration.
std::vector<std::pair<std::string_view, EstimatorKind>> estimator_kinds();
/// The kind's name in files and reports, such as "lamp_ekf".
std::string_view name(EstimatorKind kind);

/// The content of azimuth.toml. Settings that the file does not give already have the values of the preset.
struct Configuration {
  EstimatorKind estimator = EstimatorKind::by_rig;
  Preset preset = Preset::recommended;
  EkfSettings ekf;
  StageSettings stage;
  PerceptionSettings perception;
  FastSlamSettings fastslam;
  LampEkfSettings lamp_ekf;
  HindsightSettings smoother;
  HealthSettings health;                  ///< for every estimator
  RelocalisationSettings relocalisation;  ///< for every estimator
  MapStart map;                       ///< how the estimator starts from a saved map; the map itself is not part of it
  std::vector<std::string> warnings;  ///< one sentence for each entry that should be written differently
};

/// The text of an azimuth.toml that gives the same configuration; estimates made with it are the same to the last bit.
std::string configuration_text(const Configuration& configuration);

/// The tables of azimuth.toml, bound to `configuration`, which must outlive them.
std::vector<Section> configuration_sections(Configuration& configuration);

/// Reads the text of an azimuth.toml, then applies `overrides` (`section.key=value`). Violations name `file`. Relative
/// paths in the text begin in the folder of `file`; relative paths in overrides begin in the working directory.
///
/// `daemon` holds the daemon's tables, which are read along with the others. Without them the function ignores all
/// tables under [daemon].
FileResult<Configuration> read_configuration(std::string_view text, const std::string& file,
                                             std::span<const std::string> overrides = {},
                                             std::span<Section* const> daemon = {});

/// Reads the file. An empty path gives the defaults.
FileResult<Configuration> read_configuration_file(const std::filesystem::path& file,
                                                  std::span<const std::string> overrides = {},
                                                  std::span<Section* const> daemon = {});

}  // namespace azimuth
