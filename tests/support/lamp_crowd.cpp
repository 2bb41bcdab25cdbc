#include "tests/support/lamp_crowd.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <vector>

#include "slam/geometry/rigid_alignment.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

void dazzle(LampRun& run, int count, unsigned seed) {
  RandomDraws draws(seed);
  for (BearingSet& set : run.sets) {
    for (int k = 0; k < count; ++k)
      set.bearings.push_back(
          {.azimuth_rad = draws.uniform(-kPi, kPi), .elevation_rad = std::asin(draws.uniform(0.35, 1.0))});
    std::ranges::sort(set.bearings, {}, &Bearing::azimuth_rad);  // mixes the lamps with the reflections
  }
}

bool is_lamp(const LandmarkEstimate& mapped, const LampRun& run, const Pose2& T_world_map) {
  const Eigen::Vector2d flat = T_world_map * mapped.p_map_landmark_m;
  return std::ranges::any_of(run.lamps, [&](const Eigen::Vector3d& lamp) {
    return (lamp - Eigen::Vector3d(flat.x(), flat.y(), mapped.z_map_landmark_m)).norm() < kMapped_m;
  });
}

}  // namespace

LampRun crowded_hall(const LampCrowd& crowd, int seed) {
  LampRun run = simulated_hall(static_cast<std::uint64_t>(seed));
  for (BearingSet& set : run.sets) {
    if (!crowd.lamps) set.bearings.clear();
    if (crowd.on_the_robot) set.bearings.push_back({.azimuth_rad = 0.4, .elevation_rad = 0.9});
  }
  dazzle(run, crowd.anywhere, static_cast<unsigned>(seed));
  return run;
}

void CrowdOutcome::add(const CrowdOutcome& other) {
  const double share = 1.0 / (runs + other.runs);
  mean_square_m2 = share * (runs * mean_square_m2 + other.runs * other.mean_square_m2);
  anees = share * (runs * anees + other.runs * other.anees);
  runs += other.runs;
  images += other.images;
  tracking += other.tracking;
  lamps += other.lamps;
  phantoms += other.phantoms;
  reason = other.reason;
}

double CrowdOutcome::rmse_m() const { return std::sqrt(mean_square_m2); }

CrowdOutcome follow(const LampRun& run, Estimator& estimator) {
  CrowdOutcome outcome;
  outcome.runs = 1;
  Estimate estimate;
  std::vector<Eigen::Vector2d> poses, truth;
  for (std::size_t i = 0; i < run.sets.size(); ++i) {
    estimator.predict(run.motions[i]);
    estimator.update(run.sets[i]);
    estimate = {};
    estimator.estimate(estimate);
    ++outcome.images;
    outcome.tracking += estimate.health == Health::tracking ? 1 : 0;
    if (i > 0)
      outcome.anees +=
          squared_error(estimate, inverse(run.truth[0]) * run.truth[i]) / static_cast<double>(run.sets.size() - 1);
    poses.push_back(estimate.T_map_body.position());
    truth.push_back(run.truth[i].position());
  }
  const Pose2 T_world_map = align(poses, truth);
  for (std::size_t i = 0; i < truth.size(); ++i)
    outcome.mean_square_m2 += (T_world_map * poses[i] - truth[i]).squaredNorm() / static_cast<double>(truth.size());
  for (const LandmarkEstimate& mapped : estimate.landmarks)
    ++(is_lamp(mapped, run, T_world_map) ? outcome.lamps : outcome.phantoms);
  outcome.reason = estimate.reason;
  return outcome;
}

void print(const LampCrowd& crowd, const CrowdOutcome& outcome) {
  fmt::print(
      "{:<28} {:>4} of {} images tracking, {:>2} lamps mapped in {} runs and {} that are none; RMSE {:.3f} m  {}\n",
      crowd.title, outcome.tracking, outcome.images, outcome.lamps, outcome.runs, outcome.phantoms, outcome.rmse_m(),
      outcome.reason);
}

}  // namespace azimuth
