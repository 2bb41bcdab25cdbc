// Any bytes as a report. The result must be comparable values or reasons, and comparisons must be writable.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>

#include "tools/compare/compare_json.hpp"
#include "tools/compare/compare_text.hpp"
#include "tools/compare/report_files.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace azimuth;
  const FileResult<RunReport> read = read_report({reinterpret_cast<const char*>(data), size}, "report.json");
  if (!read) {
    if (text(read.error()).empty()) std::abort();
    return 0;
  }
  if (read->name.empty()) std::abort();
  for (const double value : read->values)
    if (value < 0.0 || std::isinf(value)) std::abort();
  const Reports reports{{*read}, {}};
  const CompareSettings settings = default_compare_settings();
  const Comparison comparison = compare(reports, &reports, settings);
  if (!past_limits(comparison, settings).empty() && read->failure.empty()) std::abort();
  if (!nlohmann::json::accept(json_text(comparison_json(comparison, settings, {}, "azimuth"), 0))) std::abort();
  if (comparison_text(comparison).empty()) std::abort();
  return 0;
}
