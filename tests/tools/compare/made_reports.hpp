#pragma once
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "tools/compare/comparison.hpp"

namespace azimuth::test {

/// Place of a figure in figures().
std::size_t figure(std::string_view key);

/// A report that measured these alone.
RunReport made_report(const std::string& name, std::initializer_list<std::pair<std::string_view, double>> values,
                      std::uint64_t seed = 1, std::vector<std::string> tags = {});

/// A run of a comparison by its name; there must be one.
const ComparedRun& run_named(const Comparison& comparison, const std::string& name);

/// Names of the runs with a trend in any figure, in order.
std::vector<std::string> names_with(const Comparison& comparison, Trend trend);

/// Report text as `azimuth replay` writes it, with all figures.
std::string report_text(const std::string& name, double position_rmse_m);

}  // namespace azimuth::test
