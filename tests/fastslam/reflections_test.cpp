// Many reflections from the first image on. They must neither make a map without real lamps nor be reported as
// tracking.

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "slam/particles/fastslam_estimator.hpp"
#include "tests/geometry/random_draws.hpp"
#include "tests/support/lamp_crowd.hpp"

namespace azimuth {
namespace {

constexpr int kDazzledSeeds = 6;

CrowdOutcome drive_all(const LampCrowd& crowd, const FastSlamSettings& settings) {
  CrowdOutcome sum;
  for (int seed = 1; seed <= kDazzledSeeds; ++seed) {
    const LampRun run = crowded_hall(crowd, seed);
    FastSlamEstimator estimator(run.rig, settings);
    sum.add(follow(run, estimator));
  }
  print(crowd, sum);
  return sum;
}

TEST(Reflections, AloneAreNeverCalledTracking) {
  for (const LampCrowd& crowd :
       {LampCrowd{"5 anywhere", false, 5, false}, LampCrowd{"20 anywhere", false, 20, false},
        LampCrowd{"60 anywhere", false, 60, false}, LampCrowd{"300 anywhere", false, 300, false},
        LampCrowd{"one that rides along", false, 0, true}}) {
    const CrowdOutcome outcome = drive_all(crowd, {});
    EXPECT_LE(100 * outcome.tracking, outcome.images) << crowd.title;
    EXPECT_LE(outcome.phantoms, kDazzledSeeds / 2) << crowd.title;
    EXPECT_FALSE(outcome.reason.empty());
    const CrowdOutcome paper = drive_all(crowd, paper_fastslam_preset());
    EXPECT_LE(100 * paper.tracking, paper.images) << crowd.title << ", paper";
  }
}

TEST(Reflections, AmongLampsAreNotMapped) {
  const CrowdOutcome none = drive_all({"lamps alone", true, 0, false}, {});
  EXPECT_EQ(none.lamps, 16 * kDazzledSeeds);
  EXPECT_GE(none.tracking, none.images * 95 / 100);
  for (const LampCrowd& crowd :
       {LampCrowd{"lamps, one rides along", true, 0, true}, LampCrowd{"lamps, 20 anywhere", true, 20, false},
        LampCrowd{"lamps, 60 anywhere", true, 60, false}}) {
    const CrowdOutcome outcome = drive_all(crowd, {});
    EXPECT_GE(outcome.tracking, outcome.images * 9 / 10) << crowd.title;
    EXPECT_GT(outcome.lamps, 0) << crowd.title;
    EXPECT_LE(10 * outcome.phantoms, outcome.lamps) << crowd.title;
  }
}

// Simulates the evidence of many reflections directly, without a filter.
TEST(LampEvidence, ProvesWhatIsNoLampOnceInTenThousandAtMost) {
  RandomDraws draws(7);
  constexpr int kLandmarks = 20000, kLooks = 50;
  constexpr double kSigma_rad = 0.02, kGate_rad = 0.16, kDetection = 0.85;
  const LampSighting overhead = make_sighting(0.0, 0.6, {kSigma_rad * kSigma_rad, 0.0, kSigma_rad * kSigma_rad});
  const Reflections reflections(61, 1.22);
  const double density = std::exp(reflections.log_density(overhead));
  const double in_gate = 1.0 - std::exp(-density * 4.0 * kGate_rad * kGate_rad);
  int proven = 0, refuted = 0;
  for (int i = 0; i < kLandmarks; ++i) {
    LampEvidence evidence;
    for (int image = 0; image < kLooks && !evidence.proven() && !evidence.refuted(); ++image) {
      if (!draws.chance(in_gate)) {
        evidence.missed(std::log(1.0 - kDetection));
        continue;
      }
      const double off2 =
          std::pow(draws.uniform(-kGate_rad, kGate_rad), 2) + std::pow(draws.uniform(-kGate_rad, kGate_rad), 2);
      evidence.seen(
          std::log(kDetection / (2.0 * kPi * kSigma_rad * kSigma_rad)) - 0.5 * off2 / (kSigma_rad * kSigma_rad),
          reflections.log_density(overhead));
    }
    proven += evidence.proven() ? 1 : 0;
    refuted += evidence.refuted() ? 1 : 0;
  }
  fmt::print("of {} that are no lamps {} proven, {} refuted\n", kLandmarks, proven, refuted);
  EXPECT_LE(proven, kLandmarks / 10'000 + 3);
  EXPECT_GE(refuted, kLandmarks * 99 / 100);
}

TEST(LampEvidence, ALampIsProvenInAFewImages) {
  RandomDraws draws(8);
  constexpr double kSigma_rad = 0.02, kDetection = 0.85;
  const Reflections reflections(61, 1.22);
  const LampSighting overhead = make_sighting(0.0, 0.6, {kSigma_rad * kSigma_rad, 0.0, kSigma_rad * kSigma_rad});
  int proven = 0, images = 0;
  for (int i = 0; i < 1000; ++i) {
    LampEvidence evidence;
    for (; !evidence.proven() && !evidence.refuted(); ++images) {
      const double off2 = std::pow(draws.normal(1.0), 2) + std::pow(draws.normal(1.0), 2);
      if (draws.chance(kDetection))
        evidence.seen(std::log(kDetection / (2.0 * kPi * kSigma_rad * kSigma_rad)) - 0.5 * off2,
                      reflections.log_density(overhead));
      else
        evidence.missed(std::log(1.0 - kDetection));
    }
    proven += evidence.proven() ? 1 : 0;
  }
  EXPECT_GE(proven, 990);
  EXPECT_LE(images, 10'000);
}

}  // namespace
}  // namespace azimuth
