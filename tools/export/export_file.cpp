#include "tools/export/export_file.hpp"

#include <algorithm>
#include <utility>

#include "drivers/storage/tum.hpp"
#include "tools/export/ros_recording.hpp"
#include "tools/export/text_exports.hpp"

namespace azimuth {
namespace {

std::optional<ExportFormat> format_named(std::string_view name) {
  const auto found = std::ranges::find(kExportFormats, name, &ExportFormatName::name);
  return found != kExportFormats.end() ? std::optional(found->format) : std::nullopt;
}

std::string tum_of(const Estimated& estimated) {
  std::vector<std::pair<Stamp, Pose2>> trajectory;
  for (const EstimatedPose& pose : estimated.poses) trajectory.emplace_back(pose.stamp, pose.T_map_body);
  return tum_text(trajectory);
}

}  // namespace

std::optional<ExportRequest> export_request(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon != std::string::npos && colon + 1 < text.size())
    if (const auto format = format_named(std::string_view(text).substr(0, colon)))
      return ExportRequest{*format, text.substr(colon + 1)};
  const std::string ending = std::filesystem::path(text).extension().string();
  const auto format = ending.empty() ? std::nullopt : format_named(std::string_view(ending).substr(1));
  if (!format) return std::nullopt;
  return ExportRequest{*format, text};
}

std::string export_formats_text() {
  std::string text;
  for (std::size_t i = 0; i < kExportFormats.size(); ++i)
    text.append(i == 0 ? "" : i + 1 < kExportFormats.size() ? ", " : " or ").append(kExportFormats[i].name);
  return text;
}

Exported exported(const Estimated& estimated, ExportFormat format, const std::optional<MapOrigin>& origin) {
  switch (format) {
    case ExportFormat::tum:
      return tum_of(estimated);
    case ExportFormat::kitti:
      return kitti_text(estimated);
    case ExportFormat::kitti_times:
      return kitti_times(estimated);
    case ExportFormat::csv:
      return poses_csv(estimated);
    case ExportFormat::geojson:
      return path_geojson(estimated, origin);
    case ExportFormat::bag:
      return bag_bytes(estimated);
    case ExportFormat::mcap:
      return mcap_bytes(estimated);
  }
  return tl::unexpected<std::string>("no such format");
}

}  // namespace azimuth
