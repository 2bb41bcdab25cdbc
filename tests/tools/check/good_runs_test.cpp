// Tests that `azimuth check` reports no mistake for runs that are right.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/by_kind.hpp"
#include "tests/support/data.hpp"
#include "tests/support/spoilt_run.hpp"
#include "tools/check/plausibility.hpp"
#include "tools/drive_fit/calibration.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

/// The sentences of the verdicts that call something wrong; empty if there are none.
std::string wrongs_of(const Run& run, const Drive& drive) {
  const Rig rig = test::rig_of_run(run);
  if (!why_cannot_tell(drive, rig).empty()) return "";
  std::string text;
  for (const MistakeVerdict& verdict : judge(drive, run, rig, {}).verdicts) {
    fmt::print("  {:<10} {}\n", to_string(verdict.mistake), verdict.sentence);
    if (verdict.says == MistakeVerdict::Says::wrong) text += verdict.sentence + '\n';
  }
  return text;
}

std::string wrongs_of(const Run& run) { return wrongs_of(run, test::drive_of(run, test::rig_of_run(run))); }

/// The same for bearings with kinds but without identities.
std::string wrongs_by_kind(const Run& run) { return wrongs_of(run, test::seen_by_kind(run, test::rig_of_run(run))); }

TEST(CheckGood, OneLapIsFine) { EXPECT_EQ(wrongs_of(simulated_run(lab(51, 1))), ""); }

TEST(CheckGood, BearingsThatKnowTheirRadiusAreFine) {
  EXPECT_EQ(wrongs_of(test::with_radii(simulated_run(lab(52, 1)))), "");
}

TEST(CheckGood, WhatOnlyHasKindsIsFine) { EXPECT_EQ(wrongs_by_kind(simulated_run(lab(53, 1))), ""); }

TEST(GoodRuns, OfEverySortAreFine) {
  std::vector<std::filesystem::path> folders{test::source_folder() / "runs/lab"};
  for (const char* name : {"course-301", "mrclam6-robot1", "mrclam6-robot2", "mrclam6-robot3"})
    if (const auto folder = test::data_folder() / name; std::filesystem::exists(folder)) folders.push_back(folder);
  for (const char* many : {"lab-runs", "hall-runs"})
    if (const auto parent = test::data_folder() / many; std::filesystem::exists(parent))
      for (const auto& entry : std::filesystem::directory_iterator(parent))
        if (entry.is_directory()) folders.push_back(entry.path());
  for (const auto& folder : folders) {
    fmt::print("{}\n", folder.string());
    const auto run = load_run(folder);
    ASSERT_TRUE(run) << text(run.error());
    EXPECT_EQ(wrongs_of(*run), "") << folder;
  }
}

TEST(GoodRuns, OfSimulatedWorldsAreFine) {
  for (const std::string_view world : kScenarioNames)
    for (const std::uint64_t seed : {61, 62}) {
      fmt::print("{} {}\n", world, seed);
      const auto run = simulated_run(*scenario_named(world, seed));
      EXPECT_EQ(wrongs_of(run), "") << world << ' ' << seed;
      EXPECT_EQ(wrongs_by_kind(run), "") << world << ' ' << seed << " by kind";
    }
}

}  // namespace
}  // namespace azimuth
