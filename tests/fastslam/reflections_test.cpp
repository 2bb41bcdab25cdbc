// A crowd of reflections from the first image on: a map of no real lamp must not come of it, nor be called tracking.

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vector>

#include "slam/camera/camera_model.hpp"
#include "slam/estimator/fastslam_estimator.hpp"
#include "slam/geometry/rigid_alignment.hpp"
#include "tests/geometry/random_draws.hpp"
#include "tests/support/lamp_run.hpp"

namespace azimuth {
namespace {

constexpr int kSeeds = 6;

/// Anywhere in view, never twice in the same place.
void dazzle(LampRun& run, int count, unsigned seed) {
  RandomDraws draws(seed);
  for (BearingSet& set : run.sets) {
    for (int k = 0; k < count; ++k)
      set.bearings.push_back(
          {.azimuth_rad = draws.uniform(-kPi, kPi), .elevation_rad = std::asin(draws.uniform(0.35, 1.0))});
    std::ranges::sort(set.bearings, {}, &Bearing::azimuth_rad);  // lamps come among the others
  }
}

/// Fixed to the robot: what its own lamp throws on a guard.
void ride_along(LampRun& run, double azimuth_rad, double elevation_rad) {
  for (BearingSet& set : run.sets) set.bearings.push_back({.azimuth_rad = azimuth_rad, .elevation_rad = elevation_rad});
}

void switch_off(LampRun& run) {
  for (BearingSet& set : run.sets) set.bearings.clear();
}

struct Outcome {
  int images = 0, tracking = 0;
  int lamps = 0, phantoms = 0;  ///< of the map at the end
  std::string_view reason;
};

Outcome follow(const LampRun& run, const FastSlamSettings& settings) {
  FastSlamEstimator estimator(run.rig, settings);
  Outcome outcome;
  Estimate estimate;
  std::vector<Eigen::Vector2d> poses, truth;
  for (std::size_t i = 0; i < run.sets.size(); ++i) {
    estimator.predict(run.motions[i]);
    estimator.update(run.sets[i]);
    estimate = {};
    estimator.estimate(estimate);
    ++outcome.images;
    outcome.tracking += estimate.health == Health::tracking ? 1 : 0;
    poses.push_back(estimate.T_map_body.position());
    truth.push_back(run.truth[i].position());
  }
  const Pose2 T_world_map = align(poses, truth);
  for (const LandmarkEstimate& mapped : estimate.landmarks) {
    const Eigen::Vector2d flat = T_world_map * mapped.p_map_landmark_m;
    const bool real = std::ranges::any_of(run.lamps, [&](const Eigen::Vector3d& lamp) {
      return (lamp - Eigen::Vector3d(flat.x(), flat.y(), mapped.z_map_landmark_m)).norm() < 1.5;
    });
    ++(real ? outcome.lamps : outcome.phantoms);
  }
  outcome.reason = estimate.reason;
  return outcome;
}

struct Crowd {
  const char* title;
  bool lamps;    ///< are on
  int anywhere;  ///< reflections of an image
  bool on_the_robot;
};

Outcome drive_all(const Crowd& crowd, const FastSlamSettings& settings) {
  Outcome sum;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    LampRun run = simulated_hall(static_cast<std::uint64_t>(seed));
    if (!crowd.lamps) switch_off(run);
    if (crowd.on_the_robot) ride_along(run, 0.4, 0.9);
    dazzle(run, crowd.anywhere, static_cast<unsigned>(seed));
    const Outcome one = follow(run, settings);
    sum.images += one.images;
    sum.tracking += one.tracking;
    sum.lamps += one.lamps;
    sum.phantoms += one.phantoms;
    sum.reason = one.reason;
  }
  fmt::print("{:<36} {:>4} of {} images tracking, {:>2} of {} lamps mapped and {} that are none  {}\n", crowd.title,
             sum.tracking, sum.images, sum.lamps, 16 * kSeeds, sum.phantoms, sum.reason);
  return sum;
}

TEST(Reflections, AloneAreNeverCalledTracking) {
  for (const Crowd& crowd : {Crowd{"5 anywhere", false, 5, false}, Crowd{"20 anywhere", false, 20, false},
                             Crowd{"60 anywhere", false, 60, false}, Crowd{"300 anywhere", false, 300, false},
                             Crowd{"one that rides along", false, 0, true}}) {
    const Outcome outcome = drive_all(crowd, {});
    EXPECT_LE(100 * outcome.tracking, outcome.images) << crowd.title;
    EXPECT_LE(outcome.phantoms, kSeeds / 2) << crowd.title;
    EXPECT_FALSE(outcome.reason.empty());
    const Outcome paper = drive_all(crowd, paper_fastslam_preset());
    EXPECT_LE(100 * paper.tracking, paper.images) << crowd.title << ", paper";
  }
}

TEST(Reflections, AmongLampsAreNotMapped) {
  const Outcome none = drive_all({"lamps alone", true, 0, false}, {});
  EXPECT_EQ(none.lamps, 16 * kSeeds);
  EXPECT_GE(none.tracking, none.images * 95 / 100);
  for (const Crowd& crowd :
       {Crowd{"lamps, one rides along", true, 0, true}, Crowd{"lamps, 20 anywhere", true, 20, false},
        Crowd{"lamps, 60 anywhere", true, 60, false}}) {
    const Outcome outcome = drive_all(crowd, {});
    EXPECT_GE(outcome.tracking, outcome.images * 9 / 10) << crowd.title;
    EXPECT_GT(outcome.lamps, 0) << crowd.title;
    EXPECT_LE(10 * outcome.phantoms, outcome.lamps) << crowd.title;
  }
}

// The evidence by itself, gone through as often as it takes.
TEST(LampEvidence, ProvesWhatIsNoLampOnceInTenThousandAtMost) {
  RandomDraws draws(7);
  constexpr int kLandmarks = 20000, kImages = 50;
  constexpr double kSigma_rad = 0.02, kGate_rad = 0.16, kDetection = 0.85;
  const LampSighting overhead = make_sighting(0.0, 0.6, {kSigma_rad * kSigma_rad, 0.0, kSigma_rad * kSigma_rad});
  const Reflections reflections(61, 1.22);
  const double density = std::exp(reflections.log_density(overhead));
  const double in_gate = 1.0 - std::exp(-density * 4.0 * kGate_rad * kGate_rad);
  int proven = 0, refuted = 0;
  for (int i = 0; i < kLandmarks; ++i) {
    LampEvidence evidence;
    for (int image = 0; image < kImages && !evidence.proven() && !evidence.refuted(); ++image) {
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
