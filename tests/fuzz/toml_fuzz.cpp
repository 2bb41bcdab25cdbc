// Any text as a rig, a configuration and an override. The result must be violations or values, and every value must be
// in its range.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "settings/configuration.hpp"
#include "settings/rig.hpp"

using azimuth::Configuration;
using azimuth::FileResult;
using azimuth::Key;
using azimuth::Rig;
using azimuth::Section;

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

void check_ranges(const std::vector<Section>& sections) {
  for (const Section& section : sections) {
    for (const Key& key : section.keys) require(key.in_range());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (const FileResult<Rig> read = azimuth::read_rig(text, "rig.toml")) {
    azimuth::RigKeys rig = azimuth::keys_of(*read);
    check_ranges(azimuth::rig_sections(rig));
  }
  const std::string overrides[] = {std::string(text.substr(0, text.find('\n')))};
  if (const FileResult<Configuration> read = azimuth::read_configuration(text, "azimuth.toml", overrides)) {
    Configuration configuration = *read;
    check_ranges(azimuth::configuration_sections(configuration));
  }
  return 0;
}
