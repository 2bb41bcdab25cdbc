#pragma once
// Formats a comparison and its numbers for the user.

#include <string>

#include "tools/compare/comparison.hpp"

namespace azimuth {

/// The value with its unit; "-" if not measured.
std::string value_text(const Figure& figure, double value);

/// The change, for example "+23 %", or in the figure's unit if the figure is compared by difference. Positive changes
/// are worse.
std::string change_text(const Figure& figure, double change);

/// Example: "position RMSE 0.123 m, was 0.100 m: worse by 23 %".
std::string sentence(const Figure& figure, double before, double after, double change, Trend trend);

/// Examples: "3 runs", "1 run".
std::string counted(std::size_t count, const std::string& what);

/// A plain text table: missing runs, then averages by tag, then each run, the worst first.
std::string comparison_text(const Comparison& comparison);

}  // namespace azimuth
