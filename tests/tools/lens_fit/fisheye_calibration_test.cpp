// Tests the calibration of a fisheye lens on a recorded drive.

#include "tools/lens_fit/fisheye_calibration.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "settings/rig.hpp"
#include "slam/camera/make_camera.hpp"
#include "tests/support/data.hpp"

namespace azimuth {
namespace {

using testing::HasSubstr;

class HallA : public testing::Test {
 protected:
  void SetUp() override {
    AZIMUTH_REQUIRE_DATA("hall-a");
    run_ = *load_run(test::data_folder() / "hall-a");
    rig_ = *read_rig(run_.rig_toml, run_.rig_file);
    rig_.odometry.sigma_scale_distance = 0.01;  // the measured value; the focal length scales with the driven distance
  }
  std::string problem_of(const FisheyeRequest& request = {}) const {
    std::string problem;
    EXPECT_FALSE(calibrate_fisheye(run_, rig_, {}, request, problem));
    return problem;
  }
  azimuth::Run run_;
  Rig rig_;
};

FisheyeRequest with_height(double lamp_height_m) {
  FisheyeRequest request;
  request.lamp_height_m = lamp_height_m;
  return request;
}

/// The greatest distance in the image between the pixels of one direction in two cameras, over all directions within
/// `theta_max_rad` of the optical axis.
double farthest_apart_px(const Rig& one, const Rig& other, double theta_max_rad) {
  std::string problem;
  const auto a = camera_of(one.camera, problem), b = camera_of(other.camera, problem);
  double most_px = 0.0;
  for (double theta = 0.1; theta < theta_max_rad; theta += 0.1)
    for (double azimuth = -3.0; azimuth < 3.1; azimuth += 0.5) {
      const Direction direction{azimuth, kPi / 2.0 - theta};
      most_px = std::max(most_px, (*a->pixel(direction) - *b->pixel(direction)).norm());
    }
  return most_px;
}

TEST_F(HallA, ALensThatIsOffIsFound) {
  // GIVEN a rig whose lens is 3 % too long and 8 px off
  const Rig right = rig_;
  rig_.camera.image.centre_px = {390.0, 378.7};
  auto& lens = std::get<PajdlaRig>(rig_.camera.model);
  lens.a_px *= 1.03;
  lens.c_px *= 1.03;
  // WHEN lamps at a measured height calibrate it
  std::string problem;
  const auto found = calibrate_fisheye(run_, rig_, {}, with_height(6.5), problem);
  ASSERT_TRUE(found) << problem;
  const double apart_px = farthest_apart_px(found->rig, right, found->theta_max_rad);
  fmt::print(
      "hall-a: residual {:.3f} px, {:.0f} % fit, centre ({:.2f}, {:.2f}), {:.2f} px from the true lens at most\n",
      found->solution.rms_px(), 100.0 * found->solution.fitting(), found->solution.lens.axes.centre_px.x(),
      found->solution.lens.axes.centre_px.y(), apart_px);
  // THEN the RMS residual is at most one pixel
  EXPECT_LE(found->solution.rms_px(), 1.0);
  EXPECT_GT(found->solution.fitting(), 0.8);
  EXPECT_NEAR(found->solution.lens.axes.centre_px.x(), 384.0, 1.5);
  EXPECT_NEAR(found->solution.lens.axes.centre_px.y(), 384.0, 1.5);
}

TEST_F(HallA, WhatCannotTellIsRefusedWithItsCause) {
  const Rig good = rig_;
  rig_.camera.model = HyperbolicMirrorRig{};
  EXPECT_THAT(problem_of(), HasSubstr("does not look up at lamps"));
  rig_ = good;
  rig_.camera.image.viewpoint_height_m.reset();
  EXPECT_THAT(problem_of(with_height(6.5)), HasSubstr("camera.viewpoint_height_m"));
  rig_ = good;
  const auto odometry = run_.odometry;
  for (OdometryReading& reading : run_.odometry) reading.T_odom_body = {};
  EXPECT_THAT(problem_of(), HasSubstr("the robot stands still"));
  run_.odometry = odometry;
  for (OdometryReading& reading : run_.odometry) reading.T_odom_body.heading_rad = 0.0;
  EXPECT_THAT(problem_of(), HasSubstr("its headings differ by"));
  run_.frames.clear();
  EXPECT_THAT(problem_of(), HasSubstr("has no images"));
}

}  // namespace
}  // namespace azimuth
