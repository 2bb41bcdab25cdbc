// One FastSLAM step: with names (known association) and without, by particles and lamps in the map. The ceiling is a
// grid of 9 x 4.5 m as in the second paper's hall, of which the camera sees what is within 70 degrees of the zenith.

#include <benchmark/benchmark.h>
#include <cmath>

#include "slam/estimator/lamp_association.hpp"
#include "slam/fastslam/fastslam.hpp"

namespace azimuth {
namespace {

constexpr double kHeight_m = 1.8, kCeiling_m = 6.5;
constexpr double kMaxZenith_rad = 1.2217;
constexpr double kStride_m = 0.1;
constexpr int kFewLamps = 50;  // up to so many stand in two rows, else in four

int columns_of(int lamps) { return lamps <= kFewLamps ? lamps / 2 : lamps / 4; }

std::vector<Eigen::Vector3d> grid_of_lamps(int count) {
  std::vector<Eigen::Vector3d> lamps;
  const int columns = columns_of(count), rows = count / columns;
  for (int i = 0; i < count; ++i)  // not straight above where the robot drives
    lamps.emplace_back(9.0 * (i % columns - 0.5 * (columns - 1)) + 1.3, 4.5 * (i / columns - 0.5 * (rows - 1)) + 0.7,
                       kCeiling_m);
  return lamps;
}

/// A filter that has driven to and fro below a ceiling until all lamps are mapped.
class Ceiling {
 public:
  Ceiling(int particles, int lamps, bool names)
      : lamps_(grid_of_lamps(lamps)), filter_(settings(particles), camera(names)) {
    const double reach_m = 0.5 * 9.0 * columns_of(lamps);
    for (double x = 0.0; x < reach_m; x += 0.5) drive(0.5);
    for (double x = -reach_m; x < reach_m; x += 0.5) drive(-0.5);
    for (double x = 0.0; x < reach_m; x += 0.5) drive(0.5);
  }

  void drive(double distance_m) {
    Motion motion;
    motion.T_start_end = {distance_m, 0.0, 0.0};
    motion.covariance = Eigen::Vector3d(1e-5, 1e-6, 1e-6).asDiagonal();
    motion.path_m = std::abs(distance_m);
    x_m_ += distance_m;
    look();
    filter_.predict(motion);
    filter_.update(seen_, association_);
  }

  std::size_t seen() const { return seen_.size(); }
  std::size_t mapped() const { return filter_.particles()[filter_.best()].landmarks; }
  void limit_sightings(std::size_t most) { most_seen_ = most; }

 private:
  static FastSlamSettings settings(int particles) {
    FastSlamSettings settings;
    settings.particles = particles;
    return settings;
  }
  static LampCamera camera(bool names) { return {kHeight_m, kMaxZenith_rad, 0.85, names}; }

  void look() {
    const Viewpoint from(Pose2{x_m_, 0.0, 0.0}, kHeight_m);
    seen_.clear();
    for (std::size_t i = 0; i < lamps_.size() && seen_.size() < most_seen_; ++i) {
      const Eigen::Vector2d z = direction_of(view(from, lamps_[i]), from.heading_rad);
      if (z.y() > kMaxZenith_rad) continue;
      seen_.push_back(make_sighting(z.x(), z.y(), {1e-4, 0.0, 1e-4}, static_cast<Identity>(i)));
    }
  }

  std::vector<Eigen::Vector3d> lamps_;
  FastSlam filter_;
  LampAssociation association_{LampAssociationMethod::hungarian, LampCost::logarithm};
  std::vector<LampSighting> seen_;
  std::size_t most_seen_ = 1000;
  double x_m_ = 0.0;
};

void step(benchmark::State& state, bool names) {
  const auto particles = static_cast<int>(state.range(0)), lamps = static_cast<int>(state.range(1));
  Ceiling ceiling(particles, lamps, names);
  if (names) ceiling.limit_sightings(10);
  double stride_m = kStride_m;
  std::size_t observations = 0;
  for (auto _ : state) {
    ceiling.drive(stride_m);
    stride_m = -stride_m;
    observations += ceiling.seen() * static_cast<std::size_t>(particles);
  }
  state.counters["per_observation"] =
      benchmark::Counter(static_cast<double>(observations), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["mapped"] = static_cast<double>(ceiling.mapped());
  state.counters["seen"] = static_cast<double>(ceiling.seen());
}
BENCHMARK_CAPTURE(step, named, true)
    ->Args({10, 14})
    ->Args({100, 14})
    ->Args({1000, 14})
    ->Args({1000, 100})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(step, associated, false)
    ->Args({10, 14})
    ->Args({100, 14})
    ->Args({1000, 14})
    ->Args({1000, 100})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace azimuth
