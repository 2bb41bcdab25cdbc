// Any text as a setting of an IIDC camera. An accepted setting must survive writing and reading; a refused one must be
// named.

#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "drivers/iidc/iidc_modes.hpp"
#include "drivers/iidc/iidc_text.hpp"

namespace azimuth::iidc {
namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

void check_features(std::string_view text) {
  for (const FeatureText& feature : kFeatureTexts) {
    IidcSettings settings;
    settings.*feature.text = text;
    const auto wish = parse(feature, settings);
    const auto problem = problem_of(settings);
    require(wish.has_value() != problem.has_value());
    if (problem) require(problem->key == feature.name);
    if (wish) require(wish->value <= kMaxFeatureValue && wish->second_value <= kMaxFeatureValue);
  }
}

void check_names(std::string_view text) {
  if (const auto mode = mode_named(text)) require(mode_name(*mode) == text);
  if (const auto coding = coding_named(text)) require(coding_name(*coding) == text);
  if (const auto guid = parse_guid(text)) require(parse_guid(guid_text(*guid)) == guid);
}

}  // namespace
}  // namespace azimuth::iidc

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  azimuth::iidc::check_features(text);
  azimuth::iidc::check_names(text);
  return 0;
}
