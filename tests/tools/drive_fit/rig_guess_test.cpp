// Tests the guess of a rig, its derivatives and the rig.toml that is written from it.

#include "tools/drive_fit/rig_guess.hpp"

#include <gtest/gtest.h>

#include "slam/estimator/odometry_track.hpp"

namespace azimuth {
namespace {

Bearing seen(double azimuth_rad, double radius_px) {
  Bearing bearing;
  bearing.azimuth_rad = azimuth_rad;
  bearing.radius_px = radius_px;
  return bearing;
}

TEST(RigGuess, ErrorsThatAreAppliedAreThoseOfTheOdometryTrack) {
  // GIVEN a calibrated rig and errors of scale and drift
  RigGuess guess;
  guess.rig.odometry.scale_turn = 0.9;
  guess.rig.odometry.scale_distance = 1.1;
  guess.rig.odometry.drift_rad_per_m = 0.03;
  Calibration errors = Calibration::Zero();
  errors[calibration::scale_turn] = 0.02;
  errors[calibration::drift] = -0.01;
  const auto turned_rad = [](const Rig& rig) {
    OdometryTrack track(rig.odometry);
    OdometryReading reading;
    track.add(reading);
    reading.stamp += duration_from_seconds(1.0);
    reading.T_odom_body = {1.0, 0.05, 0.1};
    track.add(reading);
    return track.advance_to(reading.stamp).T_odom_body.heading_rad;
  };
  // THEN the whole turn, which includes the old drift, grows by the scale error, and the drift error is added
  const double before_rad = turned_rad(guess.rig);
  const double driven_m = 1.1 * std::hypot(1.0, 0.05);
  EXPECT_NEAR(turned_rad(moved(guess, errors).rig), 1.02 * before_rad - 0.01 * driven_m, 1e-9);
}

TEST(RigGuess, CentreTurnsBearingsAsItsDerivativeSays) {
  for (const bool mirrored : {false, true})
    for (const double azimuth_rad : {-2.0, 0.1, 1.4}) {
      RigGuess guess;
      guess.mirrored = mirrored;
      guess.centre_px = {4.0, -7.0};
      const Bearing bearing = seen(azimuth_rad, 90.0);
      constexpr double kSmall_px = 1e-4;
      for (int axis = 0; axis < 2; ++axis) {
        RigGuess other = guess;
        other.centre_px[axis] += kSmall_px;
        const double slope = (robot_azimuth(bearing, other) - robot_azimuth(bearing, guess)) / kSmall_px;
        EXPECT_NEAR(by_centre(bearing, guess)[axis], slope, 1e-6) << azimuth_rad << ' ' << mirrored;
      }
    }
}

TEST(RigGuess, ABearingWithoutARadiusKnowsNoCentre) {
  RigGuess guess;
  guess.centre_px = {20.0, 0.0};
  const Bearing bearing = seen(1.0, std::nan(""));
  EXPECT_EQ(robot_azimuth(bearing, guess), 1.0);
  EXPECT_TRUE(by_centre(bearing, guess).isZero(0.0));
}

TEST(RigGuess, OfBearingsTheMirrorIsAKeyOfItsOwn) {
  RigGuess guess;
  guess.mirrored = true;
  guess.rig.camera.yaw_offset_rad = 0.3;
  const Rig rig = rig_saying(guess, Rig{});
  EXPECT_TRUE(rig.camera.azimuths_clockwise);
  EXPECT_EQ(rig.camera.yaw_offset_rad, 0.3);
}

TEST(RigGuess, OfImagesDirectionAndOffsetSayWhatTheGuessDoes) {
  Rig said;
  said.front_end = FrontEnd::sift;
  said.camera.image.azimuth_direction = -1;
  said.camera.image.azimuth_offset_rad = -0.5 * kPi;
  said.camera.yaw_offset_rad = 0.2;
  for (const bool mirrored : {false, true}) {
    RigGuess guess{.rig = said, .mirrored = mirrored};
    guess.rig.camera.yaw_offset_rad = 1.0;
    const Rig rig = rig_saying(guess, said);
    const auto azimuth_by = [](const Rig& each, double angle_rad) {
      return each.camera.image.azimuth_direction * angle_rad + each.camera.image.azimuth_offset_rad;
    };
    for (const double angle_rad : {-1.0, 0.4, 2.0}) {
      const double said_rad = azimuth_by(said, angle_rad);
      const double by_guess_rad = robot_azimuth(seen(said_rad, std::nan("")), guess);
      EXPECT_NEAR(wrap(azimuth_by(rig, angle_rad) + rig.camera.yaw_offset_rad - by_guess_rad), 0.0, 1e-9);
    }
  }
}

TEST(RigGuess, AnOffsetOfTheCentreGoesWhereItsAzimuthPoints) {
  Rig rig;
  rig.camera.image.azimuth_direction = -1;
  rig.camera.image.azimuth_offset_rad = -0.5 * kPi;  // azimuth 0 points up in the image, and azimuths grow to the left
  EXPECT_LT((in_image({3.0, 0.0}, rig) - Eigen::Vector2d(0.0, -3.0)).norm(), 1e-9);
  EXPECT_LT((in_image({0.0, 2.0}, rig) - Eigen::Vector2d(-2.0, 0.0)).norm(), 1e-9);
}

}  // namespace
}  // namespace azimuth
