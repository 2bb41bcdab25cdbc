#include "tests/tools/lens_fit/simulated_lens_drive.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

namespace azimuth::test {
namespace {

constexpr double kNoiseDistance_m = 9e-4, kNoiseTurn_rad = 7.757e-4, kNoiseDrift = 5e-5;
constexpr double kHeight_m = 4.7, kFarthest_rad = 1.3;

}  // namespace

Lens known_lens() {
  Lens lens;
  lens.axes = {{387.0, 379.0}, 1.0, -1, -kPi / 2.0};
  lens.radius_px = 384.0;
  lens.c = {-0.620, 0.520, 0.015, 0.130};
  return lens;
}

SimulatedLensDrive simulated_lens_drive(const LensDriveOptions& options) {
  std::mt19937_64 random(options.seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> place(-9.0, 9.0);
  SimulatedLensDrive drive;
  LensSolution& truth = drive.truth;
  truth.lens = known_lens();
  truth.lens.tilt = options.tilt;
  truth.lamp_height_m = kHeight_m;
  drive.priors.sigma_lamp_height_m = drive.priors.sigma_one_lamp_m = 0.02;
  drive.priors.lamp_height_m = kHeight_m + 0.02 * normal(random);
  truth.scale_distance_error = 0.01 * normal(random);
  truth.scale_turn_error = 0.01 * normal(random);
  for (int i = 0; i < options.lamps; ++i) truth.lamps.emplace_back(place(random), place(random), 0.02 * normal(random));
  const MotionNoise noise{kNoiseDistance_m, kNoiseTurn_rad, kNoiseDrift, 0.0};
  Pose2 pose;
  for (int i = 0; i < options.frames; ++i) {
    Motion read;
    if (i > 0) {
      const double turn = 0.07 * std::sin(0.05 * i) + 0.035;
      const Control control{0.25, 0.5 * turn, 0.5 * turn};
      append(read, control, control, noise);
      read.covariance += 1e-6 * Eigen::Matrix3d::Identity();
      pose = pose * read.T_start_end;
      const Eigen::Matrix3d root = read.covariance.llt().matrixL();
      const Eigen::Vector3d said = read.T_start_end.vector() +
                                   root * Eigen::Vector3d(normal(random), normal(random), normal(random)) -
                                   read.by_scales * Eigen::Vector2d(truth.scale_distance_error, truth.scale_turn_error);
      read.T_start_end = {said.x(), said.y(), said.z()};
    }
    drive.motions.push_back(read);
    truth.T_map_body.push_back(pose);
    SeenLamps& seen = drive.images.emplace_back();
    for (const Eigen::Vector3d& lamp : truth.lamps) {
      Eigen::Vector3d point;
      point << inverse(pose) * Eigen::Vector2d(lamp.head<2>()), kHeight_m + lamp.z();
      const double theta = std::atan2(point.head<2>().norm(), point.z());
      const auto image = truth.lens.image(point, 240.0 * theta);
      if (!image || theta > kFarthest_rad) continue;
      const Pixel off(options.sigma_px * normal(random), options.sigma_px * normal(random));
      seen.push_back({image->pixel + off, options.sigma_px * options.sigma_px * Eigen::Matrix2d::Identity()});
    }
  }
  return drive;
}

}  // namespace azimuth::test
