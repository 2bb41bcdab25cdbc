#pragma once
// azimuth.toml: everything about the estimator that is not fixed on the robot. The daemon adds tables of its own.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_result.hpp"
#include "settings/section.hpp"
#include "slam/ceiling/lamp_ekf_settings.hpp"
#include "slam/estimator/estimator_stage.hpp"
#include "slam/estimator/health_settings.hpp"
#include "slam/estimator/map_start.hpp"
#include "slam/fastslam/fastslam_settings.hpp"
#include "slam/hindsight/hindsight_settings.hpp"
#include "slam/perception/make_perception.hpp"
#include "slam/planar/ekf_settings.hpp"

namespace azimuth {

/// Where the values of keys that are not given come from.
enum class Preset {
  recommended,  ///< `preset = "default"`: what measured best
  paper         ///< what the paper prints
};

enum class FastSlamPreset { recommended, paper, paper_7deg };

struct Configuration {
  std::string estimator = "by_rig";  ///< or "ekf", "lamp_ekf", "fastslam", "smoother"; see estimator_name()
  Preset preset = Preset::recommended;
  EkfSettings ekf;  ///< follows its preset already, as all of these do
  StageSettings stage;
  PerceptionSettings perception;
  Preset identity_preset = Preset::recommended;  ///< of ekf.identity
  Preset sift_preset = Preset::recommended;      ///< of perception.sift
  FastSlamPreset fastslam_preset = FastSlamPreset::recommended;
  FastSlamSettings fastslam;
  LampEkfSettings lamp_ekf;
  HindsightSettings smoother;
  HealthSettings health;              ///< of whatever estimator; its own are not read
  MapStart map;                       ///< how to start from a saved map, without one
  std::vector<std::string> warnings;  ///< what is right today, but should be written differently; a sentence each
};

/// The text of an azimuth.toml that says the same: every estimate made with it is the same to the last bit.
std::string configuration_text(const Configuration& configuration);

/// The tables of azimuth.toml, bound to `configuration`, which must outlive them.
std::vector<Section> configuration_sections(Configuration& configuration);

/// Reads the text of an azimuth.toml, then applies `overrides` (`section.key=value`). `file` is what violations name,
/// and in its folder begin the relative paths that the text gives; those of overrides begin in the working directory.
///
/// `daemon` holds the tables of the caller's own, read along with the rest. A caller without any passes none: tables
/// under [daemon] are then left to the daemon.
FileResult<Configuration> read_configuration(std::string_view text, const std::string& file,
                                             std::span<const std::string> overrides = {},
                                             std::span<Section* const> daemon = {});

/// Reads the file; an empty path means all defaults.
FileResult<Configuration> read_configuration_file(const std::filesystem::path& file,
                                                  std::span<const std::string> overrides = {},
                                                  std::span<Section* const> daemon = {});

}  // namespace azimuth
