// Coloured landmarks, first in a small room, then in a hall. The estimator learns the camera's range from its bearings,
// and must learn it anew where the camera sees farther.

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <optional>
#include <vector>

#include "tests/scenarios/replayed.hpp"
#include "tools/evaluate/trajectory.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

constexpr int kThroughRooms = 10;
constexpr int kColoursInRooms = 4;
const Rectangle kSmallRoom{{0.0, 0.0}, {5.0, 5.0}};
const Rectangle kGreatHall{{5.0, -10.0}, {29.0, 14.0}};

bool contains(const Rectangle& room, const Eigen::Vector2d& p) {
  return (p.array() >= room.low_m.array()).all() && (p.array() <= room.high_m.array()).all();
}

/// Whether the line of sight is free: between the rooms only through the door.
bool is_open(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  constexpr double kDoor_m = 2.5, kHalfWidth_m = 0.45;
  if (contains(kSmallRoom, a) == contains(kSmallRoom, b)) return true;
  const double wall_m = kSmallRoom.high_m.x();
  const double y_m = a.y() + (b.y() - a.y()) * (wall_m - a.x()) / (b.x() - a.x());
  return std::abs(y_m - kDoor_m) < kHalfWidth_m;
}

/// A path from the room into the hall and round it, at least 7 m from the landmarks along its walls.
Scenario from_room_into_hall(std::uint64_t seed) {
  Scenario scenario = hall(seed);
  scenario.name = "rooms";
  scenario.path = laps_round({{1.3, 1.3}, {3.7, 3.7}}, 4);
  for (const Eigen::Vector2d& through_door : {Eigen::Vector2d(3.0, 2.5), Eigen::Vector2d(8.0, 2.5)})
    scenario.path.push_back(through_door);
  for (const Eigen::Vector2d& corner : laps_round({{12.0, -3.0}, {22.0, 7.0}}, 1)) scenario.path.push_back(corner);
  Random random(seed, RandomPurpose::scene);
  scenario.landmarks = scatter(kSmallRoom, 12, {0.7, 0.5}, scenario.path, random);
  for (const WorldLandmark& landmark : line_walls(kGreatHall, 3.0, 1.5, random)) scenario.landmarks.push_back(landmark);
  for (std::size_t i = 0; i < scenario.landmarks.size(); ++i) scenario.landmarks[i].identity = static_cast<Identity>(i);
  scenario.sensor.max_range_m = 15.0;
  scenario.sensor.clutter_per_set = 0.0;
  return scenario;
}

/// The run without occluded bearings. Colours replace the names of the remaining bearings.
Run seen_by_colour(std::uint64_t seed) {
  Run run = simulated_run(from_room_into_hall(seed));
  std::vector<StampedPose> truth;
  for (const TruthPose& pose : run.truth) truth.push_back({pose.stamp, pose.T_world_body});
  for (BearingSet& set : run.bearings) {
    const std::optional<Pose2> T_world_body = pose_at(truth, set.stamp);
    std::erase_if(set.bearings, [&](const Bearing& bearing) {
      const auto at = std::ranges::find(run.landmarks, bearing.identity, &TrueLandmark::identity);
      return !T_world_body || !is_open(T_world_body->position(), {at->x_m, at->y_m});
    });
    for (Bearing& bearing : set.bearings) {
      bearing.kind = static_cast<Kind>(bearing.identity % kColoursInRooms);
      bearing.identity = kUnknownIdentity;
    }
  }
  return run;
}

TEST(Rooms, AHallAfterASmallRoomIsMappedOnce) {
  const Runs runs = replay_seeds(kThroughRooms, [](std::uint64_t seed) {
    const azimuth::Run run = seen_by_colour(seed);
    Rig rig = rig_of(run);
    rig.front_end = FrontEnd::colour;
    rig.camera.identities = false;
    const Report report = replayed(run, rig);
    fmt::print(
        "seed {}: RMSE {:.3f} m, ANEES {:.1f}, {} landmarks, {} of {} mapped, {} twice, lost {} times, tracking {:.0f} "
        "%\n",
        seed, report.position_m.rmse, report.tracking_consistency.anees, report.map.landmarks, report.map.matched,
        report.map.true_landmarks, report.map.duplicates, report.health_over_time.times_lost,
        100.0 * report.health_over_time.of(Health::tracking).share);
    return report;
  });
  runs.print("from a room into a hall");
  EXPECT_EQ(runs.diverged(), 0);
  EXPECT_LE(runs.mean_m(), 0.10);
  EXPECT_LE(runs.anees(), 5.0);
  for (const Report& report : runs.reports) {
    EXPECT_EQ(report.map.matched, report.map.true_landmarks);
    EXPECT_EQ(report.health_over_time.times_lost, 0u);
  }
}

}  // namespace
}  // namespace azimuth
