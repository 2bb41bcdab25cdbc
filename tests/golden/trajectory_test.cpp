// The estimators' trajectories of some drives. An unintended change fails here, and an intended one appears as lines to
// review. scripts/refresh-golden writes the files anew.

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

#include "tests/golden/drives.hpp"
#include "tests/support/places.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth::golden {
namespace {

constexpr std::size_t kMostDifferences = 10;

bool refreshes() { return std::getenv("AZIMUTH_REFRESH_GOLDEN") != nullptr; }

std::filesystem::path file_of(const Drive& drive) {
  return test::source_folder() / "tests/golden/trajectories" / (std::string(drive.name) + ".txt");
}

std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A trajectory that still agrees within the tolerance keeps its file unchanged, so that only real changes need a
/// review.
void refresh(const Drive& drive, const Trajectory& got) {
  const auto before = from_text(content(file_of(drive)));
  if (before && differences(*before, got).empty()) return;
  std::ofstream(file_of(drive)) << to_text(got);
  std::printf("refreshed: %s\n", file_of(drive).c_str());
}

std::string listed(const std::vector<std::string>& sentences) {
  std::string text;
  for (std::size_t i = 0; i < std::min(sentences.size(), kMostDifferences); ++i) text += sentences[i] + '\n';
  if (sentences.size() > kMostDifferences)
    text += "and " + std::to_string(sentences.size() - kMostDifferences) + " more\n";
  return text + "if this was meant: scripts/refresh-golden, and review the diff";
}

class GoldenTrajectory : public testing::TestWithParam<Drive> {};

TEST_P(GoldenTrajectory, IsAsItWas) {
  const Trajectory got = thinned(GetParam().run());
  if (refreshes()) return refresh(GetParam(), got);
  const auto expected = from_text(content(file_of(GetParam())));
  ASSERT_TRUE(expected) << file_of(GetParam()) << " cannot be read: scripts/refresh-golden makes it";
  const std::vector<std::string> wrong = differences(*expected, got);
  EXPECT_TRUE(wrong.empty()) << listed(wrong);
}

INSTANTIATE_TEST_SUITE_P(Of, GoldenTrajectory, testing::ValuesIn(drives().begin(), drives().end()),
                         test::PrintedName{});

Trajectory three_steps() {
  Trajectory trajectory;
  for (std::size_t step = 1; step <= 3; ++step)
    trajectory.push_back(
        {step, {0.2 * static_cast<double>(step), 1.0, -2.0, 3.1415926, 0.1, 0.2, 0.03, 7}, "tracking"});
  return trajectory;
}

TEST(Trajectory, IsTheSameAfterItsText) {
  const auto read = from_text(to_text(three_steps()));
  ASSERT_TRUE(read);
  EXPECT_EQ(to_text(*read), to_text(three_steps()));
  EXPECT_TRUE(differences(three_steps(), *read).empty());
}

TEST(Trajectory, WhatIsNoTrajectoryIsRefused) {
  const std::string good = to_text(three_steps());
  EXPECT_FALSE(from_text(""));
  EXPECT_FALSE(from_text(good.substr(good.find('\n') + 1))) << "without its header";
  EXPECT_FALSE(from_text(good.substr(0, good.rfind(' ')))) << "cut short";
  EXPECT_FALSE(from_text(good + "4 5 more\n"));
}

TEST(Trajectory, EveryQuantityIsCompared) {
  for (std::size_t i = 0; i < kQuantities.size(); ++i) {
    Trajectory got = three_steps();
    got[1].numbers.at(i) += 0.5 * kTolerance;
    EXPECT_TRUE(differences(three_steps(), got).empty()) << kQuantities.at(i);
    got[1].numbers.at(i) += kTolerance;
    const auto wrong = differences(three_steps(), got);
    ASSERT_EQ(wrong.size(), 1u) << kQuantities.at(i);
    EXPECT_TRUE(wrong[0].starts_with("step 2: " + std::string(kQuantities.at(i)) + " expected ")) << wrong[0];
  }
}

TEST(Trajectory, HealthIsCompared) {
  Trajectory got = three_steps();
  got[2].health = "lost";
  EXPECT_EQ(differences(three_steps(), got), std::vector<std::string>{"step 3: health expected tracking, got lost"});
}

TEST(Trajectory, AHeadingThatIsAWholeTurnOffIsTheSame) {
  Trajectory got = three_steps();
  got[0].numbers[3] = -3.1415927;  // the same direction within 1e-7, across the wrap
  EXPECT_TRUE(differences(three_steps(), got).empty());
}

TEST(Trajectory, MissingStepsAreTold) {
  Trajectory got = three_steps();
  got.pop_back();
  EXPECT_EQ(differences(three_steps(), got), std::vector<std::string>{"expected 3 lines, got 2"});
}

TEST(Trajectory, IsThinnedToItsEndsAndWhereHealthChanges) {
  Trajectory many(1000);
  for (std::size_t i = 0; i < many.size(); ++i) many[i] = {.step = i + 1, .health = i == 500 ? "lost" : "tracking"};
  const Trajectory few = thinned(many);
  EXPECT_EQ(few.size(), 42u);
  EXPECT_EQ(few.front().step, 1u);
  EXPECT_EQ(few.back().step, 1000u);
  const auto has = [&](std::size_t step) { return std::ranges::find(few, step, &Waypoint::step) != few.end(); };
  EXPECT_TRUE(has(501) && has(502)) << "where it is lost, and where it no longer is";
  EXPECT_EQ(thinned(three_steps()).size(), 3u);
  EXPECT_TRUE(thinned({}).empty());
}

}  // namespace
}  // namespace azimuth::golden
