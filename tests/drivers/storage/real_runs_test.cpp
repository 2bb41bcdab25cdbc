// Every available run must load and survive a round trip through a log bit by bit.

#include <gmock/gmock.h>

#include "drivers/storage/run.hpp"
#include "tests/drivers/storage/samples.hpp"
#include "tests/support/data.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> run_folders() {
  std::vector<fs::path> folders;
  for (const auto& entry : fs::recursive_directory_iterator(test::data_folder())) {
    if (entry.path().filename() == "rig.toml") folders.push_back(entry.path().parent_path());
  }
  std::ranges::sort(folders);
  return folders;
}

TEST(RealRuns, AllLoadAndComeBackFromALog) {
  AZIMUTH_REQUIRE_DATA("");
  const auto folders = run_folders();
  if (folders.empty()) GTEST_SKIP() << "no runs in " << test::data_folder();
  const test::TemporaryFolder temporary;
  for (const fs::path& folder : folders) {
    SCOPED_TRACE(folder);
    const auto run = load_run(folder);
    ASSERT_TRUE(run) << text(run.error());
    EXPECT_FALSE(run->truth.empty());
    EXPECT_FALSE(run->landmarks.empty());
    ASSERT_TRUE(write_run_log(*run, temporary / "run.lcm"));
    const auto back = load_run(temporary / "run.lcm");
    ASSERT_TRUE(back) << text(back.error());
    test::expect_same_samples(*back, *run);
    EXPECT_EQ(back->skipped, Skipped{});
  }
}

TEST(RealRuns, RepeatedOdometryOfMrclamIsSkippedAndCounted) {
  AZIMUTH_REQUIRE_DATA("mrclam6-robot2");
  const auto run = load_run(test::data_folder() / "mrclam6-robot2");
  ASSERT_TRUE(run);
  EXPECT_EQ(run->skipped.odometry_not_in_order, 12U);
  EXPECT_EQ(run->skipped.truth_not_in_order, 0U);
}

}  // namespace
}  // namespace azimuth
