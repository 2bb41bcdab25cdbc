#include "tests/support/named_drive.hpp"

#include <cmath>

#include "slam/geometry/random.hpp"

namespace azimuth {
namespace {

constexpr MotionNoise kNoise{1e-3, 1e-3, 1e-3, 0.0};
constexpr double kFloor_m = 1e-3, kFloor_rad = 1e-3;

using Numbers = RandomNumbers<Xoshiro>;

Control with_noise(const Control& control, Numbers& numbers) {
  const Eigen::Vector4d variances = control_variances(control, kNoise);
  const auto draw = [&](int i) { return numbers.normal(std::sqrt(variances[i])); };
  return {control.distance_m + draw(0), control.first_turn_rad + draw(1),
          control.second_turn_rad + draw(2) + draw(3) + numbers.normal(kFloor_rad)};
}

Motion measured(const Control& control) {
  Motion motion;
  append(motion, control, control, kNoise);
  motion.covariance.diagonal() += Eigen::Vector3d(kFloor_m * kFloor_m, kFloor_m * kFloor_m, kFloor_rad * kFloor_rad);
  return motion;
}

}  // namespace

NamedDrive named_drive(const NamedDriveOptions& options) {
  Numbers numbers{Xoshiro(options.seed)};
  NamedDrive drive{options, {}, {}};
  // The drive starts at the origin and follows a circle to the left.
  const Eigen::Vector2d middle(0.0, options.radius_m);
  for (int i = 0; i < options.landmarks; ++i)
    drive.p_first_landmark.emplace_back(middle.x() + options.room_m * (numbers.uniform() - 0.5),
                                        middle.y() + options.room_m * (numbers.uniform() - 0.5));
  Pose2 T_first_body;
  for (int i = 0; i < options.images; ++i) {
    NamedDrive::Image image;
    if (i > 0) {
      const double turn_rad = options.step_m / options.radius_m;
      const Control said{options.step_m, 0.5 * turn_rad, 0.5 * turn_rad};
      const Control driven = with_noise(said, numbers);
      T_first_body = move(T_first_body, driven);
      image.motion = measured(
          {said.distance_m, options.scale_turn * said.first_turn_rad, options.scale_turn * said.second_turn_rad});
    }
    image.T_first_body = T_first_body;
    for (int k = 0; k < options.landmarks && static_cast<int>(image.bearings.size()) < options.most_bearings; ++k) {
      const int number = (k + i) % options.landmarks;  // each image starts with another landmark
      const Eigen::Vector2d p = inverse(T_first_body) * drive.p_first_landmark[static_cast<std::size_t>(number)];
      const double azimuth_rad = std::atan2(p.y(), p.x());
      if (p.norm() > options.range_m || p.norm() < 0.3 || std::abs(azimuth_rad) > 0.5 * options.view_rad) continue;
      const double seen_rad = numbers.uniform() < options.outliers
                                  ? numbers.uniform(-kPi, kPi)
                                  : azimuth_rad - options.camera_yaw_rad + numbers.normal(options.sigma_rad);
      image.bearings.push_back({number, wrap(seen_rad)});
    }
    drive.images.push_back(image);
  }
  return drive;
}

namespace {

/// Derivatives for images one second apart: a lag moves both ends of a motion along it, a growing lag moves the end
/// more.
ByLag by_lag(const Motion& motion, std::size_t image) {
  const Eigen::Vector3d went = motion.T_start_end.vector();
  ByLag by;
  by << 0.1 * went, went + 0.1 * static_cast<double>(image) * went;
  return by;
}

/// Derivative for a pixel 100 px from the image centre.
ByCentre by_centre(double azimuth_rad) { return 0.01 * ByCentre(std::sin(azimuth_rad), -std::cos(azimuth_rad)); }

}  // namespace

void DriveFeeder::feed(Smoother& smoother) {
  const NamedDrive::Image& image = drive_.images[next_];
  if (next_++ > 0) smoother.add_pose(image.motion, by_lag(image.motion, next_));
  for (const auto& [number, azimuth_rad] : image.bearings) {
    const BearingId bearing =
        smoother.add_bearing(azimuth_rad, drive_.options.sigma_rad, std::nullopt, by_centre(azimuth_rad));
    LandmarkId& landmark = landmark_of_[static_cast<std::size_t>(number)];
    if (landmark == kOfNothing)
      landmark = smoother.add_landmark(bearing);
    else
      smoother.assign(bearing, landmark);
  }
}

}  // namespace azimuth
