// Saved maps: the time that handing over a map costs the estimator's thread, the time to encode, check and write it in
// other threads, and an update with a fixed map compared with an update that corrects the map.

#include <benchmark/benchmark.h>
#include <filesystem>

#include "drivers/storage/map_file.hpp"
#include "slam/planar/ekf_estimator.hpp"
#include "tests/bench/world.hpp"

namespace azimuth {
namespace {

/// Landmarks that share half of their variance with each other and with the robot.
MapSnapshot map_of(int landmarks) {
  MapSnapshot map;
  map.names = MapNames::sensor;
  for (const Eigen::Vector2d& p_map_m : bench::make_landmarks(landmarks)) {
    map.landmarks.push_back(
        {.id = map.next_id, .identity = map.next_id, .sightings = 100, .p_map_landmark_m = p_map_m});
    ++map.next_id;
  }
  map.covariance.resize(map.entries());
  for (std::size_t c = 0; c < map.entries(); ++c)
    for (std::size_t r = c; r < map.entries(); ++r) map.covariance(r, c) = r == c ? 2e-4 : r % 2 == c % 2 ? 1e-4 : 0.0;
  return map;
}

Rig rig() {
  Rig rig;
  rig.camera.identities = true;
  rig.camera.sigma_bearing_rad = bench::kSigmaBearing_rad;
  return rig;
}

EkfEstimator estimator_in(const MapSnapshot& map, MapMode mode) {
  EkfSettings settings;
  settings.thinning_s = 0.0;
  return {rig(), settings, {&map, mode, true, 0.01, 0.01}};
}

void hand_over(benchmark::State& state) {
  const MapSnapshot map = map_of(static_cast<int>(state.range(0)));
  const EkfEstimator estimator = estimator_in(map, MapMode::extend);
  MapSnapshot out;
  for (auto _ : state) benchmark::DoNotOptimize(estimator.save_map(out));
}

void encode_map(benchmark::State& state) {
  const MapSnapshot map = map_of(static_cast<int>(state.range(0)));
  std::vector<std::byte> bytes;
  for (auto _ : state) encode(map, bytes);
  state.counters["bytes"] = static_cast<double>(bytes.size());
}

void write_to_disk(benchmark::State& state) {
  const auto file = std::filesystem::temp_directory_path() / "azimuth-bench.azmap";
  std::vector<std::byte> bytes;
  encode(map_of(static_cast<int>(state.range(0))), bytes);
  for (auto _ : state) benchmark::DoNotOptimize(write_map(bytes, file));
  for (const auto& name : {file, previous_map(file)}) std::filesystem::remove(name);
}

/// Decoding, including the checksum and all plausibility checks.
void decode(benchmark::State& state) {
  std::vector<std::byte> bytes;
  encode(map_of(static_cast<int>(state.range(0))), bytes);
  MapSnapshot map;
  for (auto _ : state) benchmark::DoNotOptimize(decode_map(bytes, map));
}

void update(benchmark::State& state, MapMode mode) {
  const int count = static_cast<int>(state.range(0));
  EkfEstimator estimator = estimator_in(map_of(count), mode);
  const auto landmarks = bench::make_landmarks(count);
  BearingSet set;
  for (int i = 0; i < bench::kSeen; ++i)
    set.bearings.push_back(
        {.azimuth_rad = bench::azimuth_to({}, landmarks[static_cast<std::size_t>(i)]), .identity = i});
  for (auto _ : state) {
    estimator.predict({{}, 1e-6 * Eigen::Matrix3d::Identity(), 0.0, 0.0});
    estimator.update(set);
  }
}

BENCHMARK(hand_over)->Arg(100)->Arg(2000)->Unit(benchmark::kMillisecond);
BENCHMARK(encode_map)->Arg(100)->Arg(2000)->Unit(benchmark::kMillisecond);
BENCHMARK(write_to_disk)->Arg(100)->Arg(2000)->Unit(benchmark::kMillisecond);
BENCHMARK(decode)->Arg(100)->Arg(500)->Arg(2000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(update, extending, MapMode::extend)->Arg(100)->Arg(1000)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(update, localising, MapMode::localise)->Arg(100)->Arg(1000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace azimuth
