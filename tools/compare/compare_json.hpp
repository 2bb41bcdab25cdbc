#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "tools/compare/comparison.hpp"

namespace azimuth {

/// All of it: what --json writes, and what the page shows. `made_by` names the program; `past` is past_limits().
nlohmann::ordered_json comparison_json(const Comparison& comparison, const CompareSettings& settings,
                                       const std::vector<std::string>& past, std::string_view made_by);

/// As text, whatever the names are made of.
std::string json_text(const nlohmann::ordered_json& json, int indent);

/// One page for a browser that needs nothing else.
std::string comparison_page(const nlohmann::ordered_json& comparison);

}  // namespace azimuth
