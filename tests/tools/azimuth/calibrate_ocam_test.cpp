#include <gmock/gmock.h>

#include "settings/rig.hpp"
#include "tests/tools/azimuth/command_line.hpp"

namespace azimuth::test {
namespace {

using ::testing::HasSubstr;

constexpr const char* kCalibration =
    "#polynomial coefficients for the DIRECT mapping function\n\n5 -2.1e+02 0 1.2e-03 -5e-06 1.1e-08\n\n"
    "#inverse\n3 310 140 -20\n\n#center\n238.25 321.75\n\n#affine\n0.9990 0.0021 0.0003\n\n#size\n480 640\n";

class CalibrateOcam : public testing::Test {
 protected:
  CalibrateOcam() { write_file(calibration_, kCalibration); }
  Outcome calibrate(std::vector<std::string> more) {
    more.insert(more.begin(), {"calibrate", "fisheye", "--ocam", calibration_});
    return azimuth(more);
  }
  ScratchFolder scratch_;
  std::string calibration_ = scratch_ / "calib_results.txt", rig_ = scratch_ / "rig.toml",
              base_ = scratch_ / "base.toml";
};

TEST_F(CalibrateOcam, WritesARigWithTheLens) {
  const Outcome outcome = calibrate({"--out", rig_});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("centre      camera.centre_px = [321.75, 238.49], camera.beta = 0.99900\n"));
  EXPECT_THAT(outcome.out, HasSubstr("left out    a shear that moves no pixel by more than 0.48 px\n"));
  EXPECT_THAT(outcome.out, HasSubstr("heading     cannot tell"));
  const FileResult<Rig> rig = read_rig_file(rig_);
  ASSERT_TRUE(rig) << text(rig.error());
  EXPECT_EQ(rig->front_end, FrontEnd::lamps);
  EXPECT_EQ(rig->camera.model, ModelRig((PolynomialRig{.a = {-210.0, 0.0, 1.2e-3, -5e-6, 1.1e-8}})));
  EXPECT_EQ(rig->camera.image.width_px, 640);
}

TEST_F(CalibrateOcam, KeepsWhatElseTheRigSays) {
  write_file(base_,
             "front_end = \"lamps\"\n[camera]\nmodel = \"equidistant\"\nfocal_length_px = 200\ntheta_max_rad = 1.2\n"
             "centre_px = [320, 240]\nwidth_px = 640\nheight_px = 480\nazimuth_direction = -1\nazimuth_offset_rad = "
             "0.7\nviewpoint_height_m = 1.3\n"
             "[odometry]\nlambda_distance_m = 0.01\n");
  const Outcome outcome = calibrate({"--rig", base_, "--out", rig_});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const FileResult<Rig> rig = read_rig_file(rig_);
  ASSERT_TRUE(rig) << text(rig.error());
  EXPECT_EQ(name(rig->camera.model), "polynomial");
  EXPECT_EQ(rig->camera.image.azimuth_direction, -1);
  EXPECT_EQ(rig->camera.image.azimuth_offset_rad, 0.7);
  EXPECT_EQ(rig->camera.image.viewpoint_height_m, 1.3);
  EXPECT_GT(rig->camera.image.theta_max_rad, 1.2);
  EXPECT_EQ(rig->odometry.lambda_distance_m, 0.01);
}

TEST_F(CalibrateOcam, RefusesWhatDoesNotFit) {
  write_file(base_,
             "front_end = \"colour\"\n[camera]\nmodel = \"radial\"\ncentre_px = [320, 240]\nwidth_px = 640\nheight_px "
             "= 480\n");
  EXPECT_THAT(calibrate({"--rig", base_}).err, HasSubstr("is of a mirror, which azimuth calibrate mirror is for"));
  write_file(base_,
             "front_end = \"lamps\"\n[camera]\nmodel = \"equidistant\"\nfocal_length_px = 200\ntheta_max_rad = 1.2\n"
             "centre_px = [160, 120]\nwidth_px = 320\nheight_px = 240\n");
  EXPECT_THAT(calibrate({"--rig", base_}).err, HasSubstr("is for images of another size: these are 640 x 480"));
  EXPECT_THAT(calibrate({"--picture", scratch_ / "lens.png"}).err, HasSubstr("there is no image to draw on"));
  EXPECT_EQ(calibrate({"run"}).code, 2);
  EXPECT_THAT(azimuth({"calibrate", "fisheye"}).err, HasSubstr("RUN is required"));
  write_file(calibration_, "5 -210 0 1.2e-3\n");
  const Outcome outcome = calibrate({});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("calib_results.txt: not the numbers of an OCamCalib calibration"));
}

}  // namespace
}  // namespace azimuth::test
