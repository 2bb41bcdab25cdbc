#include "tools/azimuth/exports.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <utility>

#include "tools/azimuth/command.hpp"
#include "tools/azimuth/output_path.hpp"
#include "tools/export/export_file.hpp"

namespace azimuth {
namespace {

ExportRequest request_of(const std::string& text) {
  const std::optional<ExportRequest> request = export_request(text);
  if (!request)
    refuse(text + ": its ending is no format to export to: " + export_formats_text() +
           "; a format before the name says it as well, such as kitti:poses.txt");
  return *request;
}

bool has_geojson(const ExportWishes& wishes) {
  return std::ranges::any_of(wishes.files,
                             [](const std::string& text) { return request_of(text).format == ExportFormat::geojson; });
}

std::optional<MapOrigin> origin_of(const ExportWishes& wishes) {
  if (wishes.origin.empty()) return std::nullopt;
  const std::optional<MapOrigin> origin = map_origin(wishes.origin);
  if (!origin)
    refuse("--origin " + wishes.origin + ": must be LAT,LON[,HEADING] in degrees, between 89 degrees south and north");
  return origin;
}

}  // namespace

void add_origin_option(CLI::App& command, ExportWishes& wishes) {
  command.add_option("--origin", wishes.origin,
                     "Place of the map's origin and heading of its x axis in GeoJSON, LAT,LON[,HEADING] in degrees, "
                     "heading clockwise from north; without it coordinates are metres in the map's frame");
}

void add_export_options(CLI::App& command, ExportWishes& wishes) {
  command
      .add_option("--export", wishes.files,
                  "Write path and map for other programs, in the format that the name ends with (" +
                      export_formats_text() + ") or that stands before it: kitti:poses.txt; may be repeated")
      ->type_name("[FORMAT:]FILE")
      ->allow_extra_args(false);
  add_origin_option(command, wishes);
}

void check_exports(const ExportWishes& wishes) {
  for (const std::string& text : wishes.files) check_writable(request_of(text).file);
  if (origin_of(wishes) && !has_geojson(wishes)) refuse("--origin: only GeoJSON has a place on the globe");
}

void tell_of_exports(const ExportWishes& wishes) {
  if (!has_geojson(wishes) || !wishes.origin.empty()) return;
  std::fputs(
      "coordinates are metres in the map's own frame, which the file says; --origin LAT,LON puts them on the globe\n",
      stderr);
}

void write_exports(const Estimated& estimated, const ExportWishes& wishes) {
  for (const std::string& text : wishes.files) {
    const ExportRequest request = request_of(text);
    const Exported content = exported(estimated, request.format, origin_of(wishes));
    if (!content) refuse(request.file.string() + ": cannot be written: " + content.error());
    write_text(*content, request.file);
  }
}

Estimated estimated_of(const Run& run, const ReplayResult& result) {
  Estimated estimated{.run = run.name, .poses = {}, .path = {}, .landmarks = result.last.landmarks};
  for (std::size_t i = 0; i < result.estimates.size(); ++i) {
    const EstimateRecord& estimate = result.estimates[i];
    EstimatedPose pose{estimate.stamp, estimate.T_map_body, estimate.covariance, estimate.T_odom_body, {}, {}};
    if (i < result.healths.size()) {
      pose.health = result.healths[i].health;
      pose.reason = result.healths[i].reason;
    }
    estimated.poses.push_back(std::move(pose));
  }
  for (const PastPose& past : result.past) estimated.path.push_back({past.stamp, past.T_map_body});
  return estimated;
}

Estimated refined_of(const Run& run, const ReplayResult& result) {
  if (result.past.empty()) return estimated_of(run, result);
  Estimated refined{.run = run.name, .poses = {}, .path = {}, .landmarks = result.last.landmarks};
  auto step = result.estimates.begin();
  for (const PastPose& past : result.past) {
    while (step != result.estimates.end() && step->stamp < past.stamp) ++step;
    EstimatedPose pose{past.stamp, past.T_map_body, past.covariance, {}, {}, {}};
    if (step != result.estimates.end() && step->stamp == past.stamp) pose.T_odom_body = step->T_odom_body;
    refined.poses.push_back(std::move(pose));
  }
  return refined;
}

}  // namespace azimuth
