#pragma once
// A comparison's numbers for people. Internal to tools/compare.

#include <string>

#include "tools/compare/comparison.hpp"

namespace azimuth {

/// With its unit; "-": not measured.
std::string value_text(const Figure& figure, double value);

/// "+23 %", or in the figure's unit where it is compared by difference: more is worse.
std::string change_text(const Figure& figure, double change);

/// "position RMSE 0.123 m, was 0.100 m: worse by 23 %".
std::string sentence(const Figure& figure, double before, double after, double change, Trend trend);

/// "3 runs", "1 run".
std::string counted(std::size_t count, const std::string& what);

}  // namespace azimuth
