// One step of the lamp EKF, association and upkeep of the map included, by lamps in the map. The ceiling is the grid of
// 9 x 4.5 m of the second paper's hall, of which the camera sees what is within 70 degrees of the zenith.

#include <benchmark/benchmark.h>
#include <cmath>

#include "slam/estimator/lamp_ekf_estimator.hpp"

namespace azimuth {
namespace {

constexpr double kAboveCamera_m = 4.7, kMaxZenith_rad = 1.2217, kSigma_rad = 0.005, kStride_m = 0.1;

/// A robot that drives to and fro below a ceiling until all lamps are mapped.
class Ceiling {
 public:
  explicit Ceiling(int lamps) : estimator_(rig(), {}) {
    const int columns = lamps / 2;
    for (int i = 0; i < lamps; ++i)  // not straight above where the robot drives
      lamps_.emplace_back(9.0 * (i % columns - 0.5 * (columns - 1)) + 1.3, 4.5 * (i / columns - 0.5) + 0.7);
    const double reach_m = 4.5 * columns;
    for (double x = 0.0; x < reach_m; x += 0.3) drive(0.3);
    for (double x = -reach_m; x < reach_m; x += 0.3) drive(-0.3);
    for (double x = 0.0; x < reach_m; x += 0.3) drive(0.3);
  }

  void drive(double distance_m) {
    Motion motion;
    motion.T_start_end = {distance_m, 0.0, 0.0};
    motion.covariance = Eigen::Vector3d(1e-5, 1e-6, 1e-6).asDiagonal();
    motion.path_m = std::abs(distance_m);
    x_m_ += distance_m;
    look();
    estimator_.predict(motion);
    estimator_.update(image_);
  }
  std::size_t mapped() const { return estimator_.lamps().size(); }
  std::size_t seen() const { return image_.bearings.size(); }

 private:
  static Rig rig() {
    Rig rig;
    rig.camera.image.theta_max_rad = kMaxZenith_rad;
    return rig;
  }
  void look() {
    image_.bearings.clear();
    for (const Eigen::Vector2d& lamp : lamps_) {
      const Eigen::Vector2d offset_m(lamp.x() - x_m_, lamp.y());
      const double zenith_rad = std::atan2(offset_m.norm(), kAboveCamera_m);
      if (zenith_rad > kMaxZenith_rad) continue;
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
  Ceiling ceiling(static_cast<int>(state.range(0)));
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
