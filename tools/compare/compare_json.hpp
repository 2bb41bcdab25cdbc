#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "tools/compare/comparison.hpp"

namespace azimuth {

/// The complete comparison, as --json writes it and as the page shows it. `made_by` names the program; `past` is the
/// result of past_limits().
nlohmann::ordered_json comparison_json(const Comparison& comparison, const CompareSettings& settings,
                                       const std::vector<std::string>& past, std::string_view made_by);

/// Serialises the JSON value. Invalid UTF-8 in names is replaced.
std::string json_text(const nlohmann::ordered_json& json, int indent);

/// A self-contained HTML page.
std::string comparison_page(const nlohmann::ordered_json& comparison);

}  // namespace azimuth
