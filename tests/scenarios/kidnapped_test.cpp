// A robot that is lifted, carried without turning wheels, and set down at another place on its own map.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>
#include <memory>

#include "sim/world/simulate.hpp"
#include "slam/hindsight/make_smoother_estimator.hpp"
#include "tests/support/carried.hpp"
#include "tests/support/simulated_drive.hpp"

namespace azimuth {
namespace {

constexpr double kCarried_s = 170.0, kSeconds = 10.0;
constexpr double kWrong_m = 0.5, kWrong_rad = 0.15;

/// Value of AZIMUTH_KIDNAPPINGS, else 4.
int kidnappings() {
  const char* const asked = std::getenv("AZIMUTH_KIDNAPPINGS");
  return asked != nullptr ? std::max(1, std::atoi(asked)) : 4;
}

struct Kidnapping {
  bool lost = false, found = false, wrong = false;
  double after_s = 0.0;
  std::size_t more_landmarks = 0;
};

using MakeEstimator = std::function<std::unique_ptr<Estimator>(const Rig& rig)>;

Kidnapping kidnap(const Scenario& scenario, bool names, int kinds, Duration skipped, const MakeEstimator& make) {
  World world = carried(simulate(scenario), Stamp{std::chrono::seconds(170)}, skipped);
  for (BearingSet& set : world.bearings)
    for (Bearing& bearing : set.bearings) {
      if (kinds > 0) bearing.kind = static_cast<Kind>(bearing.identity % kinds);
      if (!names) bearing.identity = kUnknownIdentity;
    }
  Rig rig = rig_of(scenario);
  rig.camera.identities = names;
  StagedDrive drive(make(rig), rig);
  Kidnapping outcome;
  std::size_t landmarks = 0;
  drive.on_estimate = [&](const Estimate& estimate) {
    const double t = to_seconds(estimate.stamp) - kCarried_s;
    if (t < 0.0) landmarks = estimate.landmarks.size();
    if (t < 0.0 || outcome.found) return;
    outcome.lost |= estimate.health == Health::lost;
    if (estimate.health != Health::tracking || t < 1.0) return;
    const Pose2 T_map_true = inverse(true_pose(world, world.bearings.front().stamp)) * true_pose(world, estimate.stamp);
    const Pose2 off = inverse(T_map_true) * estimate.T_map_body;
    outcome.found = true;
    outcome.wrong = off.position().norm() > kWrong_m || std::abs(off.heading_rad) > kWrong_rad;
    outcome.after_s = t;
    outcome.more_landmarks = estimate.landmarks.size() - std::min(landmarks, estimate.landmarks.size());
  };
  drive.run(world, Stamp{std::chrono::seconds(180)});
  return outcome;
}

std::unique_ptr<Estimator> ekf(const Rig& rig) { return std::make_unique<EkfEstimator>(rig, EkfSettings{}); }
std::unique_ptr<Estimator> smoother(const Rig& rig) { return make_smoother_estimator(rig, {}); }

void expect_found(const char* title, bool names, int kinds, const MakeEstimator& make = ekf) {
  int found = 0, wrong = 0, never_lost = 0;
  std::vector<double> after_s;
  for (int seed = 1; seed <= kidnappings(); ++seed) {
    const Scenario scenario = lab(static_cast<std::uint64_t>(seed), 4);
    const Kidnapping outcome = kidnap(scenario, names, kinds, std::chrono::seconds(23), make);
    found += outcome.found && !outcome.wrong ? 1 : 0;
    wrong += outcome.wrong ? 1 : 0;
    never_lost += outcome.lost ? 0 : 1;
    if (outcome.found && !outcome.wrong) after_s.push_back(outcome.after_s);
  }
  std::ranges::sort(after_s);
  fmt::print("{}: tracking again {} of {} within {} s, wrong {}, never called lost {}, median {:.1f} s\n", title, found,
             kidnappings(), kSeconds, wrong, never_lost, after_s.empty() ? 0.0 : after_s[after_s.size() / 2]);
  EXPECT_GE(found, kidnappings() * 95 / 100);
  EXPECT_LE(wrong, kidnappings() * 4 / 100);
}

TEST(KidnappedInTheLab, IsFoundAmongNames) { expect_found("names", true, 0); }
TEST(KidnappedInTheLab, IsFoundAmongNamesInHindsight) { expect_found("names, smoother", true, 0, smoother); }
TEST(KidnappedInTheLab, IsFoundAmongColours) { expect_found("kinds", false, 4); }

}  // namespace
}  // namespace azimuth
