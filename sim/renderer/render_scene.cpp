#include "sim/renderer/render_scene.hpp"

#include <cmath>
#include <limits>

namespace azimuth {

namespace {

constexpr double kWallDistance_m = 0.5;  // Distance of the room's walls from all its contents
constexpr double kStandRadius_m = 0.015;
constexpr PackedColour kStandPaint = colour(40, 40, 42);

Rectangle room_round(const Scenario& scenario) {
  constexpr double kFar = std::numeric_limits<double>::max();
  Rectangle room{{kFar, kFar}, {-kFar, -kFar}};
  const auto include = [&room](const Eigen::Vector2d& point) {
    room.low_m = room.low_m.cwiseMin(point);
    room.high_m = room.high_m.cwiseMax(point);
  };
  for (const WorldLandmark& landmark : scenario.landmarks) include(landmark.p_world_landmark_m);
  for (const Eigen::Vector2d& corner : scenario.path) include(corner);
  room.low_m.array() -= kWallDistance_m;
  room.high_m.array() += kWallDistance_m;
  return room;
}

/// The colour whose nearest cylinder is farthest away.
PackedColour paint_for(const Eigen::Vector2d& place, const std::vector<RenderCylinder>& standing) {
  std::array<double, kPaints.size()> nearest_m{};
  nearest_m.fill(std::numeric_limits<double>::max());
  for (const RenderCylinder& other : standing) {
    for (std::size_t i = 0; i < kPaints.size(); ++i) {
      if (kPaints[i] == other.paint) nearest_m[i] = std::min(nearest_m[i], (other.p_world_m - place).norm());
    }
  }
  return kPaints[static_cast<std::size_t>(std::ranges::max_element(nearest_m) - nearest_m.begin())];
}

void stand_up_cylinders(const Scenario& scenario, RenderScene& scene) {
  for (const WorldLandmark& landmark : scenario.landmarks) {
    const Eigen::Vector2d& place = landmark.p_world_landmark_m;
    const PackedColour paint = paint_for(place, scene.cylinders);
    scene.cylinders.push_back({place, 0.075, 0.55, 1.35, paint});
  }
  for (const WorldLandmark& landmark : scenario.landmarks) {
    scene.cylinders.push_back({landmark.p_world_landmark_m, kStandRadius_m, 0.0, 0.55, kStandPaint});
  }
}

void hang_posters(RenderScene& scene, Random& random) {
  constexpr double kPitch_m = 1.6, kWidest_m = 1.0;
  const Eigen::Vector2d size = scene.room.high_m - scene.room.low_m;
  for (int wall = 0; wall < 4; ++wall) {
    const int axis = wall % 2 == 0 ? 1 : 0;
    const int count = static_cast<int>(size[axis] / kPitch_m);
    for (int i = 0; i < count; ++i) {
      const double free_m = size[axis] / count - kWidest_m;
      const double along_m =
          scene.room.low_m[axis] + (i + 0.5) * size[axis] / count + random.uniform(-0.4, 0.4) * free_m;
      const double middle_m = random.uniform(1.1, 1.8), width_m = random.uniform(0.5, kWidest_m);
      const double height_m = random.uniform(0.4, 0.8);
      scene.posters.push_back({static_cast<Wall>(wall), along_m, middle_m, width_m, height_m,
                               scene.seed * 1000 + scene.posters.size() + 1});
    }
  }
}

void hang_lamps(RenderScene& scene) {
  constexpr double kPitch_m = 3.0;
  const Eigen::Vector2d size = scene.room.high_m - scene.room.low_m;
  const Eigen::Vector2d count = (size / kPitch_m).array().floor().max(1.0);
  for (int row = 0; row < count.y(); ++row) {
    for (int column = 0; column < count.x(); ++column) {
      const Eigen::Vector2d part = Eigen::Vector2d{column + 0.5, row + 0.5}.cwiseQuotient(count);
      scene.lamps.push_back({scene.room.low_m + part.cwiseProduct(size), 0.6, 0.6});
    }
  }
}

}  // namespace

RenderScene coloured_scene(const Scenario& scenario) {
  RenderScene scene;
  scene.room = room_round(scenario);
  scene.seed = scenario.seed;
  stand_up_cylinders(scenario, scene);
  Random random(scenario.seed, RandomPurpose::scene);
  hang_posters(scene, random);
  hang_lamps(scene);
  return scene;
}

RenderScene lamp_scene(const Scenario& scenario, double ceiling_m) {
  RenderScene scene;
  scene.room = room_round(scenario);
  scene.ceiling_m = ceiling_m;
  scene.ambient = 0.02;
  scene.seed = scenario.seed;
  for (const WorldLandmark& landmark : scenario.landmarks) {
    scene.lamps.push_back({landmark.p_world_landmark_m, 0.3, 1.2});
  }
  return scene;
}

}  // namespace azimuth
