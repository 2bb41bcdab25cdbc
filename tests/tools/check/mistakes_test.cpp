// Tests that `azimuth check` names a mistake that is put into a good run.

#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>
#include <ostream>

#include "tests/support/by_kind.hpp"
#include "tests/support/data.hpp"
#include "tests/support/drive_of.hpp"
#include "tests/support/leaning_camera.hpp"
#include "tests/support/spoilt_run.hpp"
#include "tests/tools/check/spoilings.hpp"
#include "tools/check/plausibility.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

using test::Spoiling;

Plausibility judged(const Run& run) {
  const Rig rig = test::rig_of_run(run);
  return judge(test::drive_of(run, rig), run, rig, {});
}

class CheckOneLap : public testing::TestWithParam<Spoiling> {};

TEST_P(CheckOneLap, NamesTheMistakeAndWhatWouldFit) {
  const auto good = simulated_run(lab(41, 1));
  const auto run = GetParam().spoilt(good);
  const Plausibility found = judged(run);
  EXPECT_TRUE(test::names_it(found, GetParam())) << test::said(found);
  // THEN the proposed rig has no mistake any more. The centre is exempt: the bearings were made with the wrong one.
  if (GetParam().mistake == Mistake::centre) return;
  const Plausibility again = judge(test::drive_of(run, found.rig), run, found.rig, {});
  EXPECT_FALSE(again.anything_wrong()) << test::said(again);
}

INSTANTIATE_TEST_SUITE_P(Each, CheckOneLap, testing::ValuesIn(test::spoilings()),
                         [](const auto& use) { return std::string(use.param.name); });

TEST(Check, WithoutTruthMirroredWorldsAndLengthsAreNotTold) {
  auto run = simulated_run(lab(42, 1));
  run.truth.clear();
  run.landmarks.clear();
  const Plausibility mirrored = judged(test::with_swapped_wheels(run));
  EXPECT_TRUE(mirrored.anything_wrong());
  const std::string text = test::said(mirrored);
  EXPECT_NE(text.find("camera.azimuths_clockwise = true"), std::string::npos) << text;
  EXPECT_NE(text.find("odometry.wheels_swapped = true"), std::string::npos) << text;
  const Plausibility longer = judged(test::with_scaled_distances(run, 1.3));
  EXPECT_FALSE(longer.anything_wrong()) << test::said(longer);
  EXPECT_EQ(longer.verdicts[static_cast<std::size_t>(Mistake::distance)].says, MistakeVerdict::Says::cannot_tell);
}

TEST(Check, AFlippedDirectionIsNamedWhereOnlyKindsAreTold) {
  const auto run = test::spoilings().front().spoilt(simulated_run(lab(41, 1)));
  const Rig rig = test::rig_of_run(run);
  const Plausibility found = judge(test::seen_by_kind(run, rig), run, rig, {});
  EXPECT_TRUE(test::names_it(found, test::spoilings().front())) << test::said(found);
}

TEST(Check, ACameraAheadOfTheAxleIsNoLag) {
  const auto run = test::with_mounted_camera(simulated_run(lab(41, 1)), {0.3, 0.0});
  const Plausibility found = judged(run);
  const std::string text = test::said(found);
  EXPECT_EQ(found.verdicts[static_cast<std::size_t>(Mistake::mount)].says, MistakeVerdict::Says::wrong) << text;
  EXPECT_NE(text.find("further ahead"), std::string::npos) << text;
  EXPECT_NE(text.find("camera.position_m = ["), std::string::npos) << text;
  EXPECT_NEAR(found.rig.camera.position_m[0], 0.3, 0.02);
  EXPECT_NEAR(found.rig.camera.position_m[1], 0.0, 0.02);
  EXPECT_NE(found.verdicts[static_cast<std::size_t>(Mistake::lag)].says, MistakeVerdict::Says::wrong) << text;
  const Plausibility again = judge(test::drive_of(run, found.rig), run, found.rig, {});
  EXPECT_FALSE(again.anything_wrong()) << test::said(again);
}

TEST(Check, AMountThatTheRigHasWrongIsNamedFromThere) {
  const auto run = test::with_mounted_camera(simulated_run(lab(41, 1)), {0.3, 0.0});
  Rig rig = test::rig_of_run(run);
  rig.camera.position_m = {-0.3, 0.0};
  const Plausibility found = judge(test::drive_of(run, rig), run, rig, {});
  const std::string text = test::said(found);
  EXPECT_EQ(found.verdicts[static_cast<std::size_t>(Mistake::mount)].says, MistakeVerdict::Says::wrong) << text;
  EXPECT_NEAR(found.rig.camera.position_m[0], 0.3, 0.02) << text;
}

TEST(Check, ACameraThatLeansIsNamed) {
  const auto run = test::seen_leaning(test::driven_with_good_images(41), {0.035, -0.02}, 1.5);
  const Rig rig = test::rig_of_images(run);
  const Plausibility found = judge(test::drive_of(run, rig), run, rig, {});
  const std::string text = test::said(found);
  EXPECT_EQ(found.verdicts[static_cast<std::size_t>(Mistake::tilt)].says, MistakeVerdict::Says::wrong) << text;
  EXPECT_NE(text.find("camera.roll_rad = "), std::string::npos) << text;
  EXPECT_NEAR(found.rig.camera.roll_rad, 0.035, 0.01) << text;
  EXPECT_NEAR(found.rig.camera.pitch_rad, -0.02, 0.01) << text;
}

TEST(Check, OfACameraThatIsLevelNothingIsSaid) {
  const auto run = test::seen_leaning(test::driven_with_good_images(42), {}, 1.5);
  const Rig rig = test::rig_of_images(run);
  const Plausibility found = judge(test::drive_of(run, rig), run, rig, {});
  EXPECT_EQ(found.verdicts[static_cast<std::size_t>(Mistake::tilt)].says, MistakeVerdict::Says::fits)
      << test::said(found);
}

TEST(Check, WhatItCannotTellComesWithWhatWould) {
  for (const MistakeVerdict& verdict : judged(simulated_run(lab(41, 1))).verdicts)
    if (verdict.says == MistakeVerdict::Says::cannot_tell) {
      EXPECT_NE(verdict.sentence.find("; "), std::string::npos) << verdict.sentence;
    }
}

TEST(Check, TwoMistakesAreNamedOneAfterTheOther) {
  const auto run = test::with_scaled_turns(test::with_turned_camera(simulated_run(lab(43, 1)), 0.5 * kPi), 1.3);
  const Plausibility found = judged(run);
  EXPECT_EQ(found.verdicts[static_cast<std::size_t>(Mistake::heading)].says, MistakeVerdict::Says::wrong)
      << test::said(found);
  EXPECT_EQ(found.verdicts[static_cast<std::size_t>(Mistake::turn)].says, MistakeVerdict::Says::wrong)
      << test::said(found);
}

using NamedRuns = std::vector<std::pair<std::string, Run>>;

/// Good runs of every sort that has identities.
NamedRuns good_runs() {
  NamedRuns runs;
  for (const char* name : {"mrclam6-robot2", "mrclam6-robot3", "lab-runs/lab-003"})
    if (auto run = load_run(test::data_folder() / name)) runs.emplace_back(name, *std::move(run));
  runs.emplace_back("runs/lab", *load_run(test::source_folder() / "runs/lab"));
  runs.emplace_back("scattered 7", simulated_run(scattered(7)));
  return runs;
}

/// The first six legs of the path. The time of a fit grows faster than the length of the drive.
Scenario half_of(Scenario scattered) {
  scattered.path.resize(scattered.path.size() / 2 + 1);
  return scattered;
}

/// Good runs like those of a camera: many images per metre, each with a field of view of 360 degrees.
NamedRuns good_runs_of_images() {
  NamedRuns runs;
  for (const std::uint64_t seed : {44, 45, 46})
    runs.emplace_back(fmt::format("lab {}", seed), simulated_run(lab(seed, 1)));
  runs.emplace_back("scattered 7", simulated_run(half_of(scattered(7))));
  runs.emplace_back("hall 9", simulated_run(hall(9, 1)));
  return runs;
}

using Seen = Drive (*)(const azimuth::Run& run, const Rig& rig);

void expect_named(const Spoiling& spoiling, const NamedRuns& runs, Seen seen) {
  int named = 0;
  for (const auto& [name, run] : runs) {
    const auto spoilt = spoiling.spoilt(run);
    const Rig rig = test::rig_of_run(spoilt);
    const Plausibility found = judge(seen(spoilt, rig), spoilt, rig, {});
    const bool right = test::names_it(found, spoiling);
    fmt::print("{:<16} {:<18} {}\n{}", spoiling.name, name, right ? "named" : "MISSED", right ? "" : test::said(found));
    named += right ? 1 : 0;
  }
  EXPECT_GE(named, static_cast<int>(runs.size()) - 1);
}

class Mistakes : public testing::TestWithParam<Spoiling> {};

TEST_P(Mistakes, AreNamedInEachRun) { expect_named(GetParam(), good_runs(), test::drive_of); }

TEST_P(Mistakes, AreNamedWhereOnlyKindsAreTold) {
  expect_named(GetParam(), good_runs_of_images(),
               [](const azimuth::Run& run, const Rig& rig) { return test::seen_by_kind(run, rig); });
}

INSTANTIATE_TEST_SUITE_P(Each, Mistakes, testing::ValuesIn(test::spoilings()),
                         [](const auto& use) { return std::string(use.param.name); });

}  // namespace
}  // namespace azimuth
