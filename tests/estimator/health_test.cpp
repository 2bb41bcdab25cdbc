// Health must report in time, and in words, when the pose is not reliable and when it is reliable again.

#include <gmock/gmock.h>
#include <sstream>

#include "tests/support/simulated_drive.hpp"

namespace azimuth {
namespace {

using std::chrono::seconds;

struct Change {
  Health health;
  std::string_view reason;
  friend bool operator==(const Change&, const Change&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Change& change) {
    return out << to_string(change.health) << " (" << change.reason << ")";
  }
};

/// Every change of health or reason over a run.
std::vector<Change> changes(const World& world, const Rig& rig, const EkfSettings& settings,
                            const HealthSettings& health = {}) {
  SimulatedDrive drive(rig, settings, health);
  std::vector<Change> changes;
  drive.on_estimate = [&](const Estimate& estimate) {
    const Change now{estimate.health, estimate.reason};
    if (changes.empty() || !(changes.back() == now)) changes.push_back(now);
    EXPECT_EQ(estimate.reason.empty(), estimate.health == Health::tracking);
  };
  drive.run(world);
  return changes;
}

/// Expects that `expected` occur in `all` in this order. Other changes may lie in between.
void expect_in_order(const std::vector<Change>& all, const std::vector<Change>& expected) {
  std::size_t found = 0;
  for (const Change& change : all)
    if (found < expected.size() && change == expected[found]) ++found;
  EXPECT_EQ(found, expected.size()) << "next expected: " << expected[std::min(found, expected.size() - 1)]
                                    << "\nseen: " << testing::PrintToString(all);
}

EkfSettings delayed() {
  EkfSettings settings;
  settings.initialisation = Initialisation::delayed;
  return settings;
}

template <class Change>
void change_sets(World& world, double from_s, double to_s, const Change& change) {
  for (BearingSet& set : world.bearings)
    if (to_seconds(set.stamp) > from_s && to_seconds(set.stamp) < to_s) change(set);
}

const Change kStarting{Health::starting, "no landmark mapped yet"};
const Change kTracking{Health::tracking, ""};

TEST(HealthOfTheEstimate, IsTrackingAllTheWayInAQuietLab) {
  const Scenario scenario = lab(1, 3);
  EXPECT_EQ(changes(simulate(scenario), rig_of(scenario), delayed()), (std::vector<Change>{kStarting, kTracking}));
}

TEST(HealthOfTheEstimate, IsStartingAsLongAsNothingIsSeen) {
  const Scenario scenario = lab(1, 1);
  World world = simulate(scenario);
  change_sets(world, -1.0, 1e9, [](BearingSet& set) { set.bearings.clear(); });
  EXPECT_EQ(changes(world, rig_of(scenario), delayed()), std::vector<Change>{kStarting});
}

TEST(HealthOfTheEstimate, FallsFromTrackingToLostInTheDarkAndComesBack) {
  const Scenario scenario = lab(2, 4);
  World world = simulate(scenario);
  change_sets(world, 70.0, 190.0, [](BearingSet& set) { set.bearings.clear(); });
  HealthSettings health;
  health.lost_sigma_m = 0.8;  // reached in this time with the lab's good odometry
  expect_in_order(changes(world, rig_of(scenario), delayed(), health),
                  {kStarting,
                   kTracking,
                   {Health::degraded, "no landmark recognised for long"},
                   {Health::lost, "the pose is too uncertain to be used"},
                   kTracking});
}

TEST(HealthOfTheEstimate, AnUncertainPoseIsDegradedEvenWithLandmarksInSight) {
  const Scenario scenario = lab(2, 1);
  HealthSettings strict;
  strict.degraded_sigma_m = 1e-3;
  expect_in_order(changes(simulate(scenario), rig_of(scenario), delayed(), strict),
                  {kStarting, {Health::degraded, "the pose is uncertain"}});
}

TEST(HealthOfTheEstimate, BearingsThatContradictTheMapAreReported) {
  // For ten seconds all bearings are mirrored, which no pose explains.
  const Scenario scenario = lab(3, 2);
  World world = simulate(scenario);
  change_sets(world, 75.0, 85.0, [](BearingSet& set) {
    for (Bearing& bearing : set.bearings) bearing.azimuth_rad = wrap(-bearing.azimuth_rad);
  });
  expect_in_order(changes(world, rig_of(scenario), delayed()),
                  {kStarting,
                   kTracking,
                   {Health::degraded, "bearings contradict the map"},
                   {Health::lost, "none of the landmarks is where it should be"},
                   kTracking});
}

TEST(HealthOfTheEstimate, AFullMapIsReported) {
  const Scenario scenario = lab(4, 1);
  EkfSettings small = delayed();
  small.max_landmarks = 5;
  expect_in_order(changes(simulate(scenario), rig_of(scenario), small),
                  {kStarting, kTracking, {Health::degraded, "the map is full"}});
}

TEST(HealthOfTheEstimate, PredictionsSayTooWhenTheLastLandmarkIsFarBehind) {
  const Scenario scenario = lab(5, 1);
  SimulatedDrive drive(rig_of(scenario), delayed());
  drive.run(simulate(scenario));
  Motion motion;
  motion.T_start_end.x_m = motion.path_m = 6.0;
  Estimate ahead;
  drive.estimator().look_ahead(motion, ahead);
  EXPECT_EQ(ahead.health, Health::degraded);
  EXPECT_EQ(ahead.reason, "no landmark recognised for long");
}

}  // namespace
}  // namespace azimuth
