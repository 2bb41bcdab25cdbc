#pragma once
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "tools/compare/comparison.hpp"

namespace azimuth::test {

/// Index of a figure in figures().
std::size_t figure(std::string_view key);

/// A report that contains only the given figures.
RunReport made_report(const std::string& name, std::initializer_list<std::pair<std::string_view, double>> values,
                      std::uint64_t seed = 1, std::vector<std::string> tags = {});

/// The run of a comparison with this name, which must exist.
const ComparedRun& run_named(const Comparison& comparison, const std::string& name);

/// Names of the runs in which any figure has this trend, in the order of the comparison.
std::vector<std::string> names_with(const Comparison& comparison, Trend trend);

/// Report text as `azimuth replay` writes it, with all figures.
std::string report_text(const std::string& name, double position_rmse_m);

}  // namespace azimuth::test
