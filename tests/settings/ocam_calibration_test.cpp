#include "settings/ocam_calibration.hpp"

#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <ostream>

#include "slam/camera/make_camera.hpp"
#include "tests/support/data.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth {
namespace {

std::string calibration(std::string_view direct = "5 -300 0 1e-3 0 0", std::string_view affine = "1 0 0",
                        std::string_view size = "480 640") {
  return fmt::format("#direct\n\n{}\n\n# inverse\n2 1.5 2.5\n#center\n239.5 319.25\n{}\n{}\n", direct, affine, size);
}

TEST(OcamCalibration, MakesACamera) {
  const auto read = read_ocam_calibration(calibration("5 -3e+002 +0 1e-3 0 0", "0.98 0 0"), "file");
  ASSERT_TRUE(read) << text(read.error());
  EXPECT_LT(read->left_out_px, 1e-9);
  const CameraRig* const rig = &read->camera;
  EXPECT_EQ(name(rig->model), "polynomial");
  EXPECT_EQ(rig->image.width_px, 640);
  EXPECT_EQ(rig->image.height_px, 480);
  std::string why;
  const auto camera = camera_of(*rig, why);
  ASSERT_TRUE(camera) << why;
  // 100 rows below the centre: x = 100 / 0.98.
  const double x = 100 / 0.98;
  EXPECT_NEAR(camera->direction({319.25, 339.5})->elevation_rad, kPi / 2 - std::atan2(x, 300 - 1e-3 * x * x), 1e-9);
}

/// The pixel of the direction (x, y, f(r)) in OCamCalib's convention: x points down in the image, y to the right.
Pixel ocam_pixel(const Eigen::Vector2d& p, double c, double d, double e) {
  return {e * p.x() + p.y() + 319.25, c * p.x() + d * p.y() + 239.5};
}

struct Affine {
  double c, d, e, most_px;
};

std::ostream& operator<<(std::ostream& out, const Affine& affine) {
  return out << "c " << affine.c << " d " << affine.d << " e " << affine.e;
}

class OcamAffine : public testing::TestWithParam<Affine> {};

/// Directions must agree up to a rotation about the axis, within the stated error of the neglected terms.
TEST_P(OcamAffine, IsATurnAndLittleElse) {
  const auto& [c, d, e, most_px] = GetParam();
  const auto read = read_ocam_calibration(calibration("5 -300 0 1e-3 0 0", fmt::format("{} {} {}", c, d, e)), "file");
  ASSERT_TRUE(read) << text(read.error());
  EXPECT_LT(read->left_out_px, most_px);
  std::string why;
  const auto camera = camera_of(read->camera, why);
  ASSERT_TRUE(camera) << why;
  const double turn_rad = 0.5 * (d / c - e);
  for (double psi_rad = 0.0; psi_rad < 2.0 * kPi; psi_rad += 0.3) {
    const double r_px = 200.0;
    const Eigen::Vector2d p = r_px * Eigen::Vector2d(std::sin(psi_rad), std::cos(psi_rad));
    const double theta_rad = std::atan2(r_px, 300.0 - 1e-3 * r_px * r_px);
    const auto pixel = camera->pixel(Direction{wrap(-psi_rad - turn_rad), 0.5 * kPi - theta_rad});
    ASSERT_TRUE(pixel);
    EXPECT_LT((*pixel - ocam_pixel(p, c, d, e)).norm(), read->left_out_px + 1e-3) << psi_rad;
  }
}

INSTANTIATE_TEST_SUITE_P(All, OcamAffine,
                         testing::Values(Affine{1.0, 0.0, 0.0, 1e-9}, Affine{1.0019, 0.0014, 0.0001, 0.4},
                                         Affine{0.99, 0.004, -0.0035, 0.3}, Affine{1.0, -0.01, 0.01, 0.1}),
                         test::PrintedName());

TEST(OcamCalibration, RefusesWhatItCannotHold) {
  for (const std::string& bad :
       {calibration("6 -300 0 1e-3 0 0 1e-9"), calibration("5 300 0 1e-3 0 0"), calibration("5 -300 0 1e-3 0"),
        calibration("0"), calibration("1e9 1"), calibration("5 -300 0 1e-3 0 0", "1 0.01 0"),
        calibration("5 -300 0 1e-3 0 0", "1 0 nan"), calibration("5 -300 0 1e-3 0 0", "0 0 0"),
        calibration("5 -300 0 1e-3 0 0", "1 0 0", "480"), calibration("5 -300 0 1e-3 0 0", "1 0 0", "480 640 7"),
        calibration("5 -300 0 1e-3 0 0", "1 0 0", "480.5 640"), std::string(), std::string("words")}) {
    const auto rig = read_ocam_calibration(bad, "file");
    ASSERT_FALSE(rig) << bad;
    EXPECT_EQ(rig.error().front().file, "file");
  }
  EXPECT_EQ(read_ocam_calibration("#a\n1 2\n3 x\n", "file").error().front().line, 3);
}

/// The inverse polynomial of the file is an independent fit to the same lens: radius as a function of the angle from
/// the image plane.
TEST(OcamCalibration, AgreesWithARealFilesOwnInverse) {
  const char* const kName = "mirror-calibration/calib_results_fisheye.txt";
  AZIMUTH_REQUIRE_DATA(kName);
  std::ifstream stream(test::data_folder() / kName);
  const std::string content{std::istreambuf_iterator<char>(stream), {}};
  const auto read = read_ocam_calibration(content, kName);
  ASSERT_TRUE(read) << text(read.error());
  const CameraRig* const rig = &read->camera;
  EXPECT_NEAR(rig->image.centre_px->at(0), 505.480427, 1e-9);
  EXPECT_NEAR(rig->image.centre_px->at(1), 381.777786, 1e-9);
  std::string why;
  const auto camera = camera_of(*rig, why);
  ASSERT_TRUE(camera) << why;
  const double inverse[] = {730.949123,  315.876984,  -177.960849, -352.468231,
                            -678.144608, -615.917273, -262.086205, -42.961956};
  for (double radius_px = 20; radius_px < 600; radius_px += 20) {
    const double elevation_rad = camera->direction({505.480427 + radius_px, 381.777786})->elevation_rad;
    double expected_px = 0.0, power = 1.0;
    for (const double each : inverse) {
      expected_px += each * power;
      power *= -elevation_rad;
    }
    EXPECT_NEAR(radius_px, expected_px, 0.5);
  }
}

}  // namespace
}  // namespace azimuth
