// One FastSLAM step under the ceiling of tests/bench/ceiling.hpp, with names (known association) and without, for
// different numbers of particles and lamps.

#include <benchmark/benchmark.h>

#include "slam/fastslam/fastslam.hpp"
#include "slam/particles/lamp_association.hpp"
#include "tests/bench/ceiling.hpp"
#include "tests/bench/world.hpp"

namespace azimuth {
namespace {

constexpr double kHeight_m = 1.8, kCeiling_m = 6.5;
constexpr double kStride_m = 0.1;
constexpr int kFewLamps = 50;  // up to this many lamps are in two rows, more are in four

int rows_of(int lamps) { return lamps <= kFewLamps ? 2 : 4; }

/// A filter that has driven back and forth under a ceiling until all lamps are mapped.
class FastSlamCeiling {
 public:
  FastSlamCeiling(int particles, int lamps, bool names) : filter_(settings(particles), camera(names)) {
    for (const Eigen::Vector2d& lamp : bench::ceiling_lamps(lamps, rows_of(lamps)))
      lamps_.emplace_back(lamp.x(), lamp.y(), kCeiling_m);
    bench::drive_through_hall(lamps, rows_of(lamps), 0.5, [this](double stride_m) { drive(stride_m); });
  }

  void drive(double distance_m) {
    x_m_ += distance_m;
    look();
    filter_.predict(bench::straight(distance_m));
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
  static LampCamera camera(bool names) { return {kHeight_m, bench::kMaxZenith_rad, 0.85, names}; }

  void look() {
    const Viewpoint from(Pose2{x_m_, 0.0, 0.0}, kHeight_m);
    seen_.clear();
    for (std::size_t i = 0; i < lamps_.size() && seen_.size() < most_seen_; ++i) {
      const Eigen::Vector2d z = direction_of(view(from, lamps_[i]), from.heading_rad);
      if (z.y() > bench::kMaxZenith_rad) continue;
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
  FastSlamCeiling ceiling(particles, lamps, names);
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
