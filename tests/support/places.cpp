#include "tests/support/places.hpp"

#include <cstdlib>

namespace azimuth::test {

std::filesystem::path source_folder() { return AZIMUTH_SOURCE_DIR; }

std::filesystem::path data_folder() {
  const char* const variable = std::getenv("AZIMUTH_DATA");
  return variable != nullptr ? variable : AZIMUTH_DATA_DEFAULT;
}

}  // namespace azimuth::test
