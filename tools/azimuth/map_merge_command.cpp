// azimuth map merge: makes one map from the maps of several drives in one building.

#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/visible.hpp"
#include "slam/geometry/angle.hpp"
#include "slam/map_merge/merge_maps.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/azimuth/output_path.hpp"
#include "tools/azimuth/progress_bar.hpp"
#include "tools/azimuth/replay_outputs.hpp"

namespace azimuth {
namespace {

struct MergeOptions {
  std::vector<std::filesystem::path> maps;
  std::filesystem::path out;
  bool quiet = false;
};

struct NamedMap {
  std::string name;
  MapSnapshot map;
};

/// Explains the refusal. `a` is the name of a file, or "the maps before it".
std::string sentence(MergeRefusal refusal, const std::string& a, const std::string& b) {
  switch (refusal) {
    case MergeRefusal::none:
      break;
    case MergeRefusal::looks:
      return b + ": cannot be merged with " + a + ": landmarks that are known by their looks cannot be compared yet";
    case MergeRefusal::other_names:
      return b + ": cannot be merged with " + a + ": the landmarks of one have names, those of the other have none";
    case MergeRefusal::same_origin:
      return b + ": has landmarks of " + a + " to the last bit: one was made from the other, and would count twice";
    case MergeRefusal::no_overlap:
      return b + ": nothing that it has in common with " + a +
             " is beyond chance: both drives must have mapped several of the same landmarks, three at the very least";
    case MergeRefusal::several_ways:
      return b + ": fits " + a + " in more than one way: its landmarks stand too regularly where both drives were";
  }
  return "";
}

/// Compares each map with each before any merge. After a merge it would be hidden that one map was made from another.
void check_pairs(const std::vector<NamedMap>& maps, const Progress& progress) {
  std::size_t checked = 0;
  for (std::size_t b = 0; b < maps.size(); ++b)
    for (std::size_t a = 0; a < b; ++a, progress(++checked, maps.size() * (maps.size() - 1) / 2))
      if (const MergeRefusal refusal = why_not_merged(maps[a].map, maps[b].map); refusal != MergeRefusal::none)
        refuse(sentence(refusal, maps[a].name, maps[b].name));
}

double sigma(const MergedMaps& merged, Eigen::Index i) { return std::sqrt(merged.covariance(i, i)); }

void tell(const MergedMaps& merged, const NamedMap& b, std::size_t known) {
  fmt::print(
      "merged      {}: {} of its {} landmarks are among the {} of before{}; its origin is at x {:.3f} +-{:.3f} m, "
      "y {:.3f} +-{:.3f} m, heading {:.2f} +-{:.2f} deg\n",
      visible(b.name), merged.common, b.map.landmarks.size(), known,
      merged.moved > 0 ? fmt::format(", {} left out as moved", merged.moved) : "", merged.T_a_b.x_m, sigma(merged, 0),
      merged.T_a_b.y_m, sigma(merged, 1), rad_to_degrees(merged.T_a_b.heading_rad), rad_to_degrees(sigma(merged, 2)));
}

/// Merges all maps, in the frame of the first. A map that does not overlap the merged ones may overlap a later one, so
/// it is tried again as long as other maps are added.
MapSnapshot merged_maps(std::vector<NamedMap> maps, bool quiet) {
  NamedMap whole = std::move(maps.front());
  maps.erase(maps.begin());
  while (!maps.empty()) {
    std::optional<std::string> trouble;
    auto next = maps.begin();
    for (; next != maps.end(); ++next) {
      MergedMaps merged = merge_maps(whole.map, next->map);
      if (merged.refusal == MergeRefusal::none) {
        if (!quiet) tell(merged, *next, whole.map.landmarks.size());
        whole = {"the maps before it", std::move(merged.map)};
        break;
      }
      if (!trouble) trouble = sentence(merged.refusal, whole.name, next->name);
    }
    if (next == maps.end()) refuse(*trouble);
    maps.erase(next);
  }
  return std::move(whole.map);
}

void merge(const MergeOptions& options) {
  std::error_code ignored;
  for (const std::filesystem::path& file : options.maps)
    if (std::filesystem::equivalent(file, options.out, ignored))
      refuse(options.out.string() + ": is one of the maps to be merged; merged into it, it could be counted twice");
  std::vector<NamedMap> maps;
  for (const std::filesystem::path& file : options.maps) maps.push_back({file.string(), load_map_or_refuse(file).map});
  check_writable(options.out);
  ProgressBar bar(!options.quiet, "pairs of maps");
  check_pairs(maps, bar.listener());
  bar.clear();
  const MapSnapshot merged = merged_maps(std::move(maps), options.quiet);
  const std::size_t bytes = write_map_file(merged, options.out);
  if (!options.quiet)
    fmt::print("saved       {}, {} landmarks, {} bytes\n", shown(options.out), merged.landmarks.size(), bytes);
}

}  // namespace

void add_map_merge_command(CLI::App& map) {
  CLI::App* command = map.add_subcommand("merge", "Make one map from several drives in one building");
  const auto options = std::make_shared<MergeOptions>();
  command->add_option("MAPS", options->maps, "Map files of independent drives, at least two")
      ->required()
      ->expected(2, 1000);
  command->add_option("-o,--out", options->out, "Map file to write; the earlier map is kept as FILE.previous")
      ->required();
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
  command->footer(
      "The command finds the maps' places from their common landmarks. The merged map has the frame of the first map "
      "and\nits robot's pose. It has a landmark of several maps once, more accurate than in each map alone.");
  command->callback([options] { merge(*options); });
}

}  // namespace azimuth
