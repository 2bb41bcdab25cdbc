#include "sim/world/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

namespace azimuth {
namespace {

// Adding 0 turns -0 into 0.
double rounded(double length_m) { return std::round(length_m * 1e6) / 1e6 + 0.0; }
/// Rounds towards zero, so that an angle just inside [-pi, pi) stays there.
double rounded_angle(double angle_rad) { return std::trunc(angle_rad * 1e6) / 1e6 + 0.0; }

Pose2 rounded(const Pose2& pose) { return {rounded(pose.x_m), rounded(pose.y_m), rounded_angle(pose.heading_rad)}; }

/// One drive in progress.
class Drive {
 public:
  explicit Drive(const Scenario& scenario)
      : scenario_(scenario),
        driver_(make_driver(scenario.drive, scenario.path, Random(scenario.seed, RandomPurpose::drive))),
        odometry_random_(scenario.seed, RandomPurpose::odometry),
        bearing_random_(scenario.seed, RandomPurpose::bearings),
        T_world_body_(driver_->start()) {}

  World run() {
    sample();
    while (const std::optional<Control> control = driver_->next(T_world_body_)) {
      T_world_body_ = T_world_body_ * disturbed(*control, scenario_.odometer, odometry_random_);
      T_odom_body_ = T_odom_body_ * displacement(raw(*control, scenario_.odometer));
      ++tick_;
      sample();
    }
    end();
    return std::move(world_);
  }

 private:
  std::int64_t ticks(double period_s) const {
    return std::max<std::int64_t>(1, std::llround(period_s / tick_s(scenario_.drive)));
  }
  bool due(double period_s, double phase_s = 0.0) const {
    const std::int64_t phase = std::llround(phase_s / tick_s(scenario_.drive));
    return tick_ >= phase && (tick_ - phase) % ticks(period_s) == 0;
  }
  Stamp now() const { return Stamp{duration_from_seconds(static_cast<double>(tick_) * tick_s(scenario_.drive))}; }

  void sample() {
    const Sampling& sampling = scenario_.sampling;
    if (due(sampling.odometry_period_s)) add_odometry();
    if (due(sampling.bearing_period_s, sampling.bearing_phase_s)) add_bearings();
    if (due(sampling.truth_period_s)) add_truth();
  }

  void end() {
    if (!due(scenario_.sampling.odometry_period_s)) add_odometry();
    if (!due(scenario_.sampling.truth_period_s)) add_truth();
  }

  void add_odometry() {
    const Stamp stamp = now() - duration_from_seconds(scenario_.odometer.lag_s);
    world_.odometry.push_back({stamp, world_.odometry.size(), 0, rounded(T_odom_body_)});
  }

  void add_bearings() {
    BearingSet set = observe(scenario_.landmarks, T_world_body_, scenario_.sensor, bearing_random_);
    for (Bearing& bearing : set.bearings) bearing.azimuth_rad = rounded_angle(bearing.azimuth_rad);
    set.stamp = now();
    set.sequence = world_.bearings.size();
    world_.bearings.push_back(std::move(set));
  }

  void add_truth() { world_.truth.push_back({now(), rounded(T_world_body_)}); }

  const Scenario& scenario_;
  std::unique_ptr<Driver> driver_;
  Random odometry_random_, bearing_random_;
  Pose2 T_world_body_, T_odom_body_;
  std::int64_t tick_ = 0;
  World world_;
};

}  // namespace

World simulate(const Scenario& scenario) { return Drive(scenario).run(); }

}  // namespace azimuth
