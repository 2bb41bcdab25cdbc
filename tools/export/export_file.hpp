#pragma once
// Formats of exports, and export to a given format.

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/export/estimated.hpp"
#include "tools/map_export/geojson_parts.hpp"

namespace azimuth {

enum class ExportFormat : std::uint8_t { tum, kitti, kitti_times, csv, geojson, bag, mcap };

/// Format names for the option --export: the file name extension, or a prefix if the extension differs.
struct ExportFormatName {
  std::string_view name;
  ExportFormat format;
};
inline constexpr std::array<ExportFormatName, 7> kExportFormats{{
    {"tum", ExportFormat::tum},
    {"kitti", ExportFormat::kitti},
    {"kitti_times", ExportFormat::kitti_times},
    {"csv", ExportFormat::csv},
    {"geojson", ExportFormat::geojson},
    {"bag", ExportFormat::bag},
    {"mcap", ExportFormat::mcap},
}};

/// Format and name of a file to write.
struct ExportRequest {
  ExportFormat format = ExportFormat::tum;
  std::filesystem::path file;
};

/// Parses a text such as "drive.mcap" or "kitti:poses.txt"; nothing if it does not determine the format.
std::optional<ExportRequest> export_request(const std::string& text);

/// All formats as text for the user: "tum, kitti, ... or mcap".
std::string export_formats_text();

/// The content of the file, or the reason for the failure. Precondition: at least one pose. `origin` is only used for
/// GeoJSON.
Exported exported(const Estimated& estimated, ExportFormat format, const std::optional<MapOrigin>& origin);

}  // namespace azimuth
