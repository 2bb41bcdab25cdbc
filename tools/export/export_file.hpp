#pragma once
// Which format is asked for, and what is estimated in it.

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

/// As --export takes them. What ends the name of a file, and stands before it where the name ends otherwise.
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

/// A file to be written.
struct ExportRequest {
  ExportFormat format = ExportFormat::tum;
  std::filesystem::path file;
};

/// "drive.mcap", or "kitti:poses.txt"; nothing when neither says the format.
std::optional<ExportRequest> export_request(const std::string& text);

/// All formats, for a person: "tum, kitti, ... or mcap".
std::string export_formats_text();

/// The file's content, or why there can be none. At least one pose there must be. `origin` is for GeoJSON alone.
Exported exported(const Estimated& estimated, ExportFormat format, const std::optional<MapOrigin>& origin);

}  // namespace azimuth
