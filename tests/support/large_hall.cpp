#include "tests/support/large_hall.hpp"

#include <cmath>

namespace azimuth {
namespace {

double length_m(const Path& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

double driven_m(const Scenario& scenario, double minutes) {
  return 60.0 * minutes * std::get<SmoothDrive>(scenario.drive).speed_m_per_s;
}

/// A path up one lane and down the next, and back along the wall.
Path lanes(const LargeHall& hall) {
  const int count = 2 * static_cast<int>(std::lround(0.5 * hall.side_m / hall.lane_m));
  const double low_m = 0.5 * hall.lane_m, high_m = hall.side_m - low_m;
  const double between_m = (high_m - low_m) / (count - 1);
  Path path;
  for (int lane = 0; lane < count; ++lane) {
    const double x_m = low_m + lane * between_m;
    const bool up = lane % 2 == 0;
    path.emplace_back(x_m, up ? low_m + hall.lane_m : high_m);
    path.emplace_back(x_m, up ? high_m : low_m + hall.lane_m);
  }
  path.emplace_back(high_m, low_m);
  path.emplace_back(low_m, low_m);
  path.push_back(path.front());
  return path;
}

}  // namespace

Scenario large_hall(std::uint64_t seed, double minutes, const LargeHall& hall) {
  Scenario scenario = lab(seed);
  scenario.name = "large-hall";
  const Path lap = lanes(hall);
  Random random(seed, RandomPurpose::scene);
  scenario.landmarks = scatter({{0.0, 0.0}, {hall.side_m, hall.side_m}}, hall.landmarks, Spacing{}, lap, random);
  scenario.sensor.max_range_m = 6.0;
  scenario.path = lap;
  while (length_m(scenario.path) < driven_m(scenario, minutes))
    scenario.path.insert(scenario.path.end(), lap.begin() + 1, lap.end());
  return scenario;
}

Scenario long_lab(std::uint64_t seed, double minutes) {
  const Scenario once = lab(seed, 1);
  const int laps = static_cast<int>(std::ceil(driven_m(once, minutes) / length_m(once.path)));
  return lab(seed, laps);
}

}  // namespace azimuth
