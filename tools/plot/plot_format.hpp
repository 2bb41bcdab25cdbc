#pragma once
#include <filesystem>
#include <optional>

namespace azimuth {

/// Format of a picture: PNG (pixels), SVG or PDF (vector graphics).
enum class PlotFormat { png, svg, pdf };

/// The format by the file name extension, in upper or lower case; nothing for other extensions.
std::optional<PlotFormat> plot_format(const std::filesystem::path& file);

}  // namespace azimuth
