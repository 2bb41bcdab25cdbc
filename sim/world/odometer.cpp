#include "sim/world/odometer.hpp"

#include <cmath>

#include "sim/world/driver.hpp"

namespace azimuth {
namespace {

double sigma(double lambda, double amount) { return std::sqrt(lambda * std::abs(amount)); }

}  // namespace

Pose2 disturbed(const Control& control, const OdometerSettings& settings, Random& random) {
  Control noisy = control;
  noisy.distance_m += random.normal(sigma(settings.lambda_distance_m, control.distance_m));
  noisy.first_turn_rad += random.normal(sigma(settings.lambda_rotation_rad, control.first_turn_rad));
  noisy.second_turn_rad += random.normal(sigma(settings.lambda_rotation_rad, control.second_turn_rad));
  noisy.second_turn_rad += random.normal(sigma(settings.lambda_drift_rad2_per_m, control.distance_m));

  Pose2 T_start_end = displacement(noisy);
  const double slip_m = random.normal(settings.sigma_lateral_m_per_sqrt_m * std::sqrt(std::abs(control.distance_m)));
  T_start_end.x_m -= slip_m * std::sin(noisy.first_turn_rad);
  T_start_end.y_m += slip_m * std::cos(noisy.first_turn_rad);
  return T_start_end;
}

Control raw(const Control& control, const OdometerSettings& settings) {
  const double drift_rad = settings.drift_rad_per_m * control.distance_m;
  return {control.distance_m / settings.scale_distance, control.first_turn_rad / settings.scale_turn,
          (control.second_turn_rad - drift_rad) / settings.scale_turn};
}

}  // namespace azimuth
