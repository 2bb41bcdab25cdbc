#pragma once
// The shipped DBC file, which describes the base that azimuth-sim simulates.

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>

#include "drivers/can/dbc.hpp"
#include "tests/support/places.hpp"

namespace azimuth::test {

inline Dbc shipped_dbc() {
  std::ifstream file(test::source_folder() / "config/simulated-can.dbc");
  const std::string content{std::istreambuf_iterator<char>(file), {}};
  const FileResult<Dbc> read = read_dbc(content, "simulated-can.dbc");
  EXPECT_TRUE(read) << text(read.error());
  return read ? *read : Dbc{};
}

}  // namespace azimuth::test
