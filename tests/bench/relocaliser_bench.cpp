// One image of the relocalisation of a lost robot: 100 landmarks, 20 directions, all hypotheses in use.

#include <benchmark/benchmark.h>
#include <random>

#include "slam/localisation/relocaliser.hpp"

namespace azimuth {
namespace {

void lost_in_the_plane(benchmark::State& state) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> place(0.0, 40.0), azimuth(-kPi, kPi);
  std::vector<KnownLandmark> known(100);
  for (KnownLandmark& landmark : known) {
    landmark.p_map_m = {place(engine), place(engine), std::numeric_limits<double>::quiet_NaN()};
    landmark.covariance_m2 = 1e-3 * Eigen::Matrix3d::Identity();
  }
  std::vector<SeenDirection> seen(20);
  for (SeenDirection& direction : seen) direction = {.azimuth_rad = azimuth(engine), .sigma_rad = 0.02};
  Motion step;
  step.T_start_end.x_m = step.path_m = 0.2;
  step.covariance.diagonal() << 1e-4, 1e-4, 1e-4;
  Relocaliser relocaliser{RelocalisationSettings{}};
  relocaliser.start(known, CameraView{});
  for (auto _ : state) {
    relocaliser.update(seen);
    relocaliser.predict(step);
  }
}
BENCHMARK(lost_in_the_plane)->Unit(benchmark::kMillisecond);

void lost_below_lamps(benchmark::State& state) {
  std::vector<KnownLandmark> known(100);
  for (std::size_t i = 0; i < known.size(); ++i) {
    known[i].p_map_m = {4.5 * static_cast<double>(i % 10), 4.5 * static_cast<double>(i / 10), 6.5};
    known[i].covariance_m2 = 1e-3 * Eigen::Matrix3d::Identity();
  }
  const CameraView view{.height_m = 1.8, .min_elevation_rad = 0.35, .detection_probability = 0.85};
  Motion step;
  step.T_start_end.x_m = step.path_m = 0.2;
  step.covariance.diagonal() << 1e-4, 1e-4, 1e-4;
  Relocaliser relocaliser{RelocalisationSettings{}};
  relocaliser.start(known, view);
  Pose2 T_map_body{10.0, 20.0, 0.1};
  std::vector<SeenDirection> seen;
  for (auto _ : state) {
    seen.clear();
    for (const KnownLandmark& lamp : known) {
      const Eigen::Vector3d v = CameraPlace(T_map_body, 1.8)(lamp);
      const double elevation_rad = std::atan2(v.z(), v.head<2>().norm());
      if (elevation_rad > 0.4 && seen.size() < 20)
        seen.push_back({.azimuth_rad = std::atan2(v.y(), v.x()),
                        .sigma_rad = 0.02,
                        .elevation_rad = elevation_rad,
                        .sigma_elevation_rad = 0.01});
    }
    relocaliser.update(seen);
    relocaliser.predict(step);
    T_map_body = T_map_body * Pose2{0.2, 0.0, 0.02};
  }
}
BENCHMARK(lost_below_lamps)->Iterations(60)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace azimuth
