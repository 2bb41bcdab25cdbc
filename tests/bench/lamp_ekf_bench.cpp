// One step of the lamp EKF under the ceiling of tests/bench/ceiling.hpp, including association and map maintenance, for
// different numbers of lamps in the map.

#include <benchmark/benchmark.h>
#include <cmath>

#include "slam/ceiling/lamp_ekf_estimator.hpp"
#include "tests/bench/ceiling.hpp"
#include "tests/bench/world.hpp"

namespace azimuth {
namespace {

constexpr int kRows = 2;
constexpr double kAboveCamera_m = 4.7, kSigma_rad = 0.005, kStride_m = 0.1;

/// A robot that has driven back and forth under a ceiling until all lamps are mapped.
class LampEkfCeiling {
 public:
  explicit LampEkfCeiling(int lamps) : estimator_(rig(), {}), lamps_(bench::ceiling_lamps(lamps, kRows)) {
    bench::drive_through_hall(lamps, kRows, 0.3, [this](double stride_m) { drive(stride_m); });
  }

  void drive(double distance_m) {
    x_m_ += distance_m;
    look();
    estimator_.predict(bench::straight(distance_m));
    estimator_.update(image_);
  }
  std::size_t mapped() const { return estimator_.lamps().size(); }
  std::size_t seen() const { return image_.bearings.size(); }

 private:
  static Rig rig() {
    Rig rig;
    rig.camera.image.theta_max_rad = bench::kMaxZenith_rad;
    return rig;
  }
  void look() {
    image_.bearings.clear();
    for (const Eigen::Vector2d& lamp : lamps_) {
      const Eigen::Vector2d offset_m(lamp.x() - x_m_, lamp.y());
      const double zenith_rad = std::atan2(offset_m.norm(), kAboveCamera_m);
      if (zenith_rad > bench::kMaxZenith_rad) continue;
      image_.bearings.push_back({.azimuth_rad = std::atan2(offset_m.y(), offset_m.x()),
                                 .elevation_rad = kPi / 2.0 - zenith_rad,
                                 .sigma_rad = kSigma_rad / std::sin(zenith_rad),
                                 .sigma_elevation_rad = kSigma_rad});
    }
  }

  LampEkfEstimator estimator_;
  std::vector<Eigen::Vector2d> lamps_;
  BearingSet image_;
  double x_m_ = 0.0;
};

void lamp_ekf_step(benchmark::State& state) {
  LampEkfCeiling ceiling(static_cast<int>(state.range(0)));
  double stride_m = kStride_m;
  for (auto _ : state) {
    ceiling.drive(stride_m);
    stride_m = -stride_m;
  }
  state.counters["mapped"] = static_cast<double>(ceiling.mapped());
  state.counters["seen"] = static_cast<double>(ceiling.seen());
}
BENCHMARK(lamp_ekf_step)->Arg(14)->Arg(50)->Arg(100)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace azimuth
