// Counts the mistakes that `azimuth check` names in thirty runs of five sorts. The runs violate its assumptions: stamps
// jitter, errors have heavy tails and wheels slip.

#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "slam/geometry/angle.hpp"
#include "tests/support/by_kind.hpp"
#include "tests/support/drive_of.hpp"
#include "tests/support/spoilt_run.hpp"
#include "tests/tools/check/spoilings.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

using test::Spoiling;

struct Sort {
  const char* name;
  Scenario (*scenario)(std::uint64_t seed);
  Drive (*seen)(const Run& run, const Rig& rig);
  double most_s = 90.0;            ///< Length of the drive that is used.
  double knows_heading_rad = 0.0;  ///< A smaller heading error is not observable: four standard deviations.
};

Drive seen_by_kind(const Run& run, const Rig& rig) { return test::seen_by_kind(run, rig); }

const Sort kSorts[] = {
    {"lab", [](std::uint64_t seed) { return lab(seed, 1); }, test::drive_of},
    {"lab by kind", [](std::uint64_t seed) { return lab(seed, 1); }, seen_by_kind},
    {"hall", [](std::uint64_t seed) { return hall(seed, 1); }, test::drive_of},
    {"corridor", [](std::uint64_t seed) { return corridor(seed, 2); }, test::drive_of, 170.0, degrees_to_rad(2.1)},
    {"scattered", [](std::uint64_t seed) { return scattered(seed, 1); }, test::drive_of},
};
/// Number of runs of each sort. The variable AZIMUTH_SEEDS overrides it for a quick test.
std::uint64_t seeds() {
  const char* given = std::getenv("AZIMUTH_SEEDS");  // NOLINT(concurrency-mt-unsafe): the test has one thread
  return given != nullptr ? std::strtoull(given, nullptr, 10) : 6;
}

Plausibility judged(const Sort& sort, const Run& run) {
  const Rig rig = test::rig_of_run(run);
  return judge(sort.seen(run, rig), run, rig, {});
}

Run rough_run(const Sort& sort, std::uint64_t seed) {
  return test::roughened(first_seconds(simulated_run(sort.scenario(seed)), sort.most_s), seed);
}

class ThirtyRunsOf : public testing::TestWithParam<Spoiling> {};

TEST_P(ThirtyRunsOf, NameTheMistake) {
  const Spoiling& spoiling = GetParam();
  int named = 0, wrongly = 0, runs = 0;
  for (const Sort& sort : kSorts)
    for (std::uint64_t seed = 301; seed < 301 + seeds(); ++seed) {
      const Plausibility found = judged(sort, spoiling.spoilt(rough_run(sort, seed)));
      const bool wrong = test::names_another(found, spoiling);
      const bool right =
          test::names_it(found, spoiling) || (!wrong && std::abs(spoiling.by_rad) < sort.knows_heading_rad);
      fmt::print("{:<16} {:<12} {} {}\n{}", spoiling.name, sort.name, seed,
                 right ? "named" : (wrong ? "WRONG NAME" : "MISSED"), right ? "" : test::said(found));
      named += right ? 1 : 0;
      wrongly += wrong ? 1 : 0;
      ++runs;
    }
  fmt::print("{}: named in {} of {}, a wrong name in {}\n", spoiling.name, named, runs, wrongly);
  EXPECT_LE(wrongly, 1);
  EXPECT_GE(named, runs - 1);
}

INSTANTIATE_TEST_SUITE_P(Each, ThirtyRunsOf, testing::ValuesIn(test::further_spoilings()),
                         [](const auto& use) { return std::string(use.param.name); });

TEST(ThirtyRuns, OfWhatIsRightNothingIsSaid) {
  int called = 0;
  for (const Sort& sort : kSorts)
    for (std::uint64_t seed = 301; seed < 301 + seeds(); ++seed) {
      const Plausibility found = judged(sort, rough_run(sort, seed));
      fmt::print("{:<12} {} {}\n{}", sort.name, seed, found.anything_wrong() ? "WRONG NAME" : "nothing",
                 found.anything_wrong() ? test::said(found) : "");
      called += found.anything_wrong() ? 1 : 0;
    }
  EXPECT_EQ(called, 0);
}

}  // namespace
}  // namespace azimuth
