#include "tools/plot/plot_format.hpp"

#include <algorithm>
#include <string>

namespace azimuth {

std::optional<PlotFormat> plot_format(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  if (ending == ".png") return PlotFormat::png;
  if (ending == ".svg") return PlotFormat::svg;
  if (ending == ".pdf") return PlotFormat::pdf;
  return std::nullopt;
}

}  // namespace azimuth
