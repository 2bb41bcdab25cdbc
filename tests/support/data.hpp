#pragma once
// Support for tests that need runs which are not shipped.

#include <filesystem>
#include <gtest/gtest.h>

#include "tests/support/places.hpp"

/// Skips the running test, with a message, if `name` is not in the folder of real runs.
#define AZIMUTH_REQUIRE_DATA(name)                                                                         \
  do {                                                                                                     \
    if (!std::filesystem::exists(::azimuth::test::data_folder() / (name)))                                 \
      GTEST_SKIP() << "no " << (name) << " in " << ::azimuth::test::data_folder() << "; set AZIMUTH_DATA"; \
  } while (false)
