#pragma once
#include <filesystem>
#include <optional>

namespace azimuth {

/// What a picture is written as: pixels, or strokes that stay sharp at any size.
enum class PlotFormat { png, svg, pdf };

/// By the ending of the file's name, whatever its case; nothing when it is another one.
std::optional<PlotFormat> plot_format(const std::filesystem::path& file);

}  // namespace azimuth
