#include "settings/configuration.hpp"

#include <utility>

#include "settings/colour_section.hpp"
#include "settings/configuration_sections.hpp"
#include "settings/file_text.hpp"
#include "settings/path_text.hpp"
#include "settings/reader.hpp"
#include "settings/toml_writing.hpp"

namespace azimuth {
namespace {

void apply_preset(Configuration& configuration) {
  if (configuration.preset == Preset::recommended) return;
  configuration.ekf = paper_preset();
  configuration.relocalisation.lost_log_odds = 0.0;  // neither paper has a relocalisation
  configuration.ekf.identity = paper_identity_preset();
  configuration.perception.sift = paper_sift_preset();
  configuration.fastslam =
      configuration.preset == Preset::paper_7deg ? paper_7deg_fastslam_preset() : paper_fastslam_preset();
}

/// Returns the configuration that was read through `sections`, with the preset's values in place of the defaults. A key
/// that the file gives overrides the preset, wherever the key `preset` is in the file.
Configuration with_preset(const Configuration& read, const std::vector<Section>& sections) {
  Configuration result = read;
  apply_preset(result);
  std::vector<Section> of_result = configuration_sections(result);
  for (std::size_t i = 0; i < sections.size(); ++i) copy_given(sections[i], of_result[i]);
  return result;
}

}  // namespace

std::vector<std::pair<std::string_view, EstimatorKind>> estimator_kinds() {
  return {{"by_rig", EstimatorKind::by_rig},
          {"ekf", EstimatorKind::ekf},
          {"lamp_ekf", EstimatorKind::lamp_ekf},
          {"fastslam", EstimatorKind::fastslam},
          {"smoother", EstimatorKind::smoother}};
}

std::string_view name(EstimatorKind kind) { return estimator_kinds().at(static_cast<std::size_t>(kind)).first; }

std::vector<Section> configuration_sections(Configuration& configuration) {
  std::vector<Section> sections = estimator_sections(configuration);
  sections.push_back(colour_section(configuration.perception.colour));
  return sections;
}

std::string configuration_text(const Configuration& configuration) {
  Configuration copy = configuration;
  std::vector<Section> sections = configuration_sections(copy);
  for (Section& section : sections)
    for (Key& key : section.keys) key.given = true;
  std::string text;
  for (const Section& section : sections) text += toml_text(section);
  return text;
}

FileResult<Configuration> read_configuration(std::string_view text, const std::string& file,
                                             std::span<const std::string> overrides, std::span<Section* const> daemon) {
  static constexpr std::string_view kLeftToTheDaemon[] = {"daemon"};
  Configuration configuration;
  std::vector<Section> sections = configuration_sections(configuration);
  std::vector<Section*> tables = pointers(sections);
  tables.insert(tables.end(), daemon.begin(), daemon.end());

  const auto others =
      daemon.empty() ? std::span<const std::string_view>(kLeftToTheDaemon) : std::span<const std::string_view>();
  FileErrors violations = read_toml(text, file, tables, others, &configuration.warnings);
  for (std::string& warning : place_paths(tables, file)) configuration.warnings.push_back(std::move(warning));
  for (const std::string& assignment : overrides) {
    if (daemon.empty() && assignment.starts_with("daemon."))
      violations.push_back({"--set " + assignment, 0, "is the daemon's alone: only azimuthd takes it"});
    else
      for (FileError& violation : apply_override(assignment, tables)) violations.push_back(std::move(violation));
  }
  if (!violations.empty()) return failure(std::move(violations));
  return with_preset(configuration, sections);
}

FileResult<Configuration> read_configuration_file(const std::filesystem::path& file,
                                                  std::span<const std::string> overrides,
                                                  std::span<Section* const> daemon) {
  if (file.empty()) return read_configuration("", "", overrides, daemon);
  return file_text(file).and_then(
      [&](const std::string& text) { return read_configuration(text, file.string(), overrides, daemon); });
}

}  // namespace azimuth
