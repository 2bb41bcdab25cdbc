#pragma once
// A folder for a recorder, and access to its sessions.

#include <filesystem>
#include <gtest/gtest.h>

#include "tests/daemon/record/recording.hpp"

namespace azimuth::test {

class RecorderTest : public testing::Test {
 protected:
  RecordSettings settings() const {
    RecordSettings settings;
    settings.folder = folder_.path();
    settings.min_free_mb = 0.0;
    return settings;
  }
  std::filesystem::path session() const { return sessions(folder_.path()).back(); }

  TemporaryFolder folder_;
};

inline void expect_readings(const Run& run, std::uint64_t first, std::uint64_t end) {
  ASSERT_EQ(run.odometry.size(), end - first);
  for (std::uint64_t i = first; i < end; ++i) ASSERT_EQ(run.odometry[i - first], reading(i)) << i;
}

}  // namespace azimuth::test
