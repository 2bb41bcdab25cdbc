#pragma once
// Where tests find the runs that are not shipped.

#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>

namespace azimuth::test {

/// The folder of real runs: environment variable AZIMUTH_DATA, else ../shared/data beside the source tree. It need not
/// exist.
inline std::filesystem::path data_folder() {
  const char* const variable = std::getenv("AZIMUTH_DATA");
  return variable != nullptr ? variable : AZIMUTH_DATA_DEFAULT;
}

}  // namespace azimuth::test

/// Leaves the running test as skipped, visibly, when `name` is not in the folder of real runs.
#define AZIMUTH_REQUIRE_DATA(name)                                                                         \
  do {                                                                                                     \
    if (!std::filesystem::exists(::azimuth::test::data_folder() / (name)))                                 \
      GTEST_SKIP() << "no " << (name) << " in " << ::azimuth::test::data_folder() << "; set AZIMUTH_DATA"; \
  } while (false)
