#include "tools/drive_fit/rig_guess.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

constexpr double kNearCentre_px = 2.0;  // pixels nearer to the centre have no meaningful azimuth

/// The two numbers in the slots of lag and lag growth.
Eigen::Vector2d motion_numbers(const RigGuess& guess) {
  const OdometryRig& odometry = guess.rig.odometry;
  switch (guess.numbers) {
    case MotionNumbers::clock:
      return {odometry.lag_s, odometry.clock_drift};
    case MotionNumbers::jump:
      return {odometry.lag_s, guess.jump.by_s};
    case MotionNumbers::mount:
      return mount_of(guess.rig);
  }
  return Eigen::Vector2d::Zero();
}

void move_motion_numbers(const Eigen::Vector2d& by, RigGuess& guess) {
  if (guess.numbers == MotionNumbers::mount) {
    std::array<double, 2>& position_m = guess.rig.camera.position_m;
    position_m = {position_m[0] + by.x(), position_m[1] + by.y()};
    return;
  }
  guess.rig.odometry.lag_s += by.x();
  (guess.numbers == MotionNumbers::jump ? guess.jump.by_s : guess.rig.odometry.clock_drift) += by.y();
}

}  // namespace

Eigen::Vector2d mount_of(const Rig& rig) { return {rig.camera.position_m[0], rig.camera.position_m[1]}; }

Calibration numbers_of(const RigGuess& guess) {
  const OdometryRig& odometry = guess.rig.odometry;
  Calibration numbers;
  numbers << odometry.scale_distance, odometry.scale_turn, odometry.drift_rad_per_m, motion_numbers(guess),
      guess.rig.camera.yaw_offset_rad, guess.centre_px, Eigen::Vector2d::Zero();
  return numbers;
}

RigGuess moved(const RigGuess& guess, const Calibration& errors) {
  RigGuess result = guess;
  OdometryRig& odometry = result.rig.odometry;
  const double longer = 1.0 + errors[calibration::scale_distance], wider = 1.0 + errors[calibration::scale_turn];
  odometry.scale_distance *= longer;
  odometry.scale_turn *= wider;
  // The measured turn already contains the drift of the guess.
  odometry.drift_rad_per_m = (odometry.drift_rad_per_m * wider + errors[calibration::drift]) / longer;
  move_motion_numbers(errors.segment<2>(calibration::lag), result);
  result.rig.camera.yaw_offset_rad = wrap(result.rig.camera.yaw_offset_rad + errors[calibration::yaw]);
  result.centre_px += errors.segment<2>(calibration::centre_x);
  return result;
}

Eigen::Matrix<double, kCalibrations, kCalibrations> by_errors(const RigGuess& guess) {
  Eigen::Matrix<double, kCalibrations, kCalibrations> by =
      Eigen::Matrix<double, kCalibrations, kCalibrations>::Identity();
  const OdometryRig& odometry = guess.rig.odometry;
  by(calibration::scale_distance, calibration::scale_distance) = odometry.scale_distance;
  by(calibration::scale_turn, calibration::scale_turn) = odometry.scale_turn;
  by(calibration::drift, calibration::scale_turn) = odometry.drift_rad_per_m;
  by(calibration::drift, calibration::scale_distance) = -odometry.drift_rad_per_m;
  return by;
}

double robot_azimuth(const Bearing& bearing, const RigGuess& guess) {
  double azimuth_rad = bearing.azimuth_rad;
  if (!std::isnan(bearing.radius_px) && !guess.centre_px.isZero(0.0)) {
    const Eigen::Vector2d pixel =
        bearing.radius_px * Eigen::Vector2d(std::cos(azimuth_rad), std::sin(azimuth_rad)) - guess.centre_px;
    if (pixel.norm() > kNearCentre_px) azimuth_rad = std::atan2(pixel.y(), pixel.x());
  }
  return wrap((guess.mirrored ? -azimuth_rad : azimuth_rad) + guess.rig.camera.yaw_offset_rad);
}

ByCentre by_centre(const Bearing& bearing, const RigGuess& guess) {
  if (std::isnan(bearing.radius_px)) return ByCentre::Zero();
  const Eigen::Vector2d pixel =
      bearing.radius_px * Eigen::Vector2d(std::cos(bearing.azimuth_rad), std::sin(bearing.azimuth_rad)) -
      guess.centre_px;
  const double square_px2 = pixel.squaredNorm();
  if (square_px2 < kNearCentre_px * kNearCentre_px) return ByCentre::Zero();
  const double hand = guess.mirrored ? -1.0 : 1.0;
  return hand / square_px2 * ByCentre(pixel.y(), -pixel.x());
}

bool sees_images(const Rig& rig) { return rig.front_end != FrontEnd::bearings; }

Rig rig_saying(const RigGuess& guess, const Rig& said_before) {
  Rig rig = guess.rig;
  if (!sees_images(rig)) {
    if (guess.mirrored) rig.camera.azimuths_clockwise = !said_before.camera.azimuths_clockwise;
    return rig;
  }
  // azimuth = direction * angle + offset. The yaw offset keeps its value, since it is a measured mounting angle.
  ImageRig& image = rig.camera.image;
  const double by_rad = guess.rig.camera.yaw_offset_rad - said_before.camera.yaw_offset_rad;
  if (guess.mirrored) image.azimuth_direction = -image.azimuth_direction;
  image.azimuth_offset_rad = wrap(by_rad + (guess.mirrored ? -1.0 : 1.0) * image.azimuth_offset_rad);
  rig.camera.yaw_offset_rad = said_before.camera.yaw_offset_rad;
  return rig;
}

std::string direction_text(const Rig& rig) {
  if (sees_images(rig)) return fmt::format("camera.azimuth_direction = {}", rig.camera.image.azimuth_direction);
  return fmt::format("camera.azimuths_clockwise = {}", rig.camera.azimuths_clockwise);
}

std::string heading_text(const Rig& rig) {
  if (sees_images(rig)) return fmt::format("camera.azimuth_offset_rad = {:.4f}", rig.camera.image.azimuth_offset_rad);
  return fmt::format("camera.yaw_offset_rad = {:.4f}", rig.camera.yaw_offset_rad);
}

Eigen::Vector2d in_image(const Eigen::Vector2d& centre_px, const Rig& rig) {
  const ImageRig& image = rig.camera.image;
  if (centre_px.isZero(0.0)) return centre_px;
  const double angle_rad =
      image.azimuth_direction * (std::atan2(centre_px.y(), centre_px.x()) - image.azimuth_offset_rad);
  return centre_px.norm() * Eigen::Vector2d(std::cos(angle_rad), image.beta * std::sin(angle_rad));
}

}  // namespace azimuth
