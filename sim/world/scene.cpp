#include "sim/world/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace azimuth {
namespace {

double distance_to_segment(const Eigen::Vector2d& point, const Eigen::Vector2d& start, const Eigen::Vector2d& end) {
  const Eigen::Vector2d along = end - start;
  const double squared = along.squaredNorm();
  const double fraction = squared > 0.0 ? std::clamp(along.dot(point - start) / squared, 0.0, 1.0) : 0.0;
  return (point - start - fraction * along).norm();
}

Eigen::Vector2d random_point(const Rectangle& area, Random& random) {
  const double x = random.uniform(area.low_m.x(), area.high_m.x());
  const double y = random.uniform(area.low_m.y(), area.high_m.y());
  return {x, y};
}

bool clear_of(const std::vector<WorldLandmark>& landmarks, const Eigen::Vector2d& point, double distance_m) {
  return std::none_of(landmarks.begin(), landmarks.end(), [&](const WorldLandmark& landmark) {
    return (landmark.p_world_landmark_m - point).norm() < distance_m;
  });
}

}  // namespace

Path laps_round(const Rectangle& rectangle, int laps) {
  const auto& [low, high] = rectangle;
  Path path{low};
  for (int lap = 0; lap < laps; ++lap) {
    path.emplace_back(high.x(), low.y());
    path.push_back(high);
    path.emplace_back(low.x(), high.y());
    path.push_back(low);
  }
  return path;
}

Path there_and_back(const Eigen::Vector2d& start, const Eigen::Vector2d& end, int laps) {
  Path path{start};
  for (int lap = 0; lap < laps; ++lap) {
    path.push_back(end);
    path.push_back(start);
  }
  return path;
}

Path wander(const Rectangle& area, int corners, double min_leg_m, Random& random) {
  constexpr int kMaxTriesEach = 1000;
  Path path{random_point(area, random)};
  for (int tries = 0; static_cast<int>(path.size()) < corners && tries < kMaxTriesEach * corners; ++tries) {
    const Eigen::Vector2d corner = random_point(area, random);
    if ((corner - path.back()).norm() >= min_leg_m) path.push_back(corner);
  }
  return path;
}

double distance_to_path(const Eigen::Vector2d& point, const Path& path) {
  double nearest = path.empty() ? INFINITY : (point - path.front()).norm();
  for (std::size_t i = 1; i < path.size(); ++i)
    nearest = std::min(nearest, distance_to_segment(point, path[i - 1], path[i]));
  return nearest;
}

std::vector<WorldLandmark> scatter(const Rectangle& area, int count, const Spacing& spacing, const Path& path,
                                   Random& random) {
  constexpr int kMaxTriesEach = 1000;
  std::vector<WorldLandmark> landmarks;
  for (int tries = 0; static_cast<int>(landmarks.size()) < count && tries < kMaxTriesEach * count; ++tries) {
    const Eigen::Vector2d point = random_point(area, random);
    if (distance_to_path(point, path) < spacing.from_path_m) continue;
    if (!clear_of(landmarks, point, spacing.between_landmarks_m)) continue;
    landmarks.push_back({static_cast<Identity>(landmarks.size()), point});
  }
  return landmarks;
}

std::vector<WorldLandmark> line_walls(const Rectangle& room, double pitch_m, double depth_m, Random& random) {
  const Eigen::Vector2d size = room.high_m - room.low_m;
  const std::array<Eigen::Vector2d, 4> corners{room.low_m, Eigen::Vector2d{room.high_m.x(), room.low_m.y()},
                                               room.high_m, Eigen::Vector2d{room.low_m.x(), room.high_m.y()}};
  std::vector<WorldLandmark> landmarks;
  for (std::size_t wall = 0; wall < 4; ++wall) {
    const double length_m = wall % 2 == 0 ? size.x() : size.y();
    const Eigen::Vector2d along = (corners[(wall + 1) % 4] - corners[wall]) / length_m;
    const Eigen::Vector2d inwards{-along.y(), along.x()};
    const int count = std::max(1, static_cast<int>(length_m / pitch_m));
    for (int i = 0; i < count; ++i) {
      const double place_m = (i + 0.5 + random.uniform(-0.25, 0.25)) * length_m / count;
      const double into_m = random.uniform(0.0, depth_m);
      landmarks.push_back(
          {static_cast<Identity>(landmarks.size()), corners[wall] + place_m * along + into_m * inwards});
    }
  }
  return landmarks;
}

}  // namespace azimuth
