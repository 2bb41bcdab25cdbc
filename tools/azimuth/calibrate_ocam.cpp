#include "tools/azimuth/calibrate_ocam.hpp"

#include <fmt/format.h>

#include "settings/file_text.hpp"
#include "settings/ocam_calibration.hpp"
#include "settings/rig.hpp"
#include "slam/camera/make_camera.hpp"
#include "tools/azimuth/calibrate_chessboard.hpp"
#include "tools/azimuth/command.hpp"

namespace azimuth {
namespace {

OcamCalibration calibration_or_refuse(const std::filesystem::path& file) {
  const FileResult<std::string> text = file_text(file);
  if (!text) refuse(text.error());
  FileResult<OcamCalibration> calibration = read_ocam_calibration(*text, file.string());
  if (!calibration) refuse(calibration.error());
  return *std::move(calibration);
}

/// Returns the rig with its own mounting and masks, and with the lens that was read.
Rig with_lens(Rig rig, const CameraRig& lens) {
  ImageRig& image = rig.camera.image;
  rig.camera.model = lens.model;
  image.beta = lens.image.beta;
  image.centre_px = lens.image.centre_px;
  image.theta_max_rad = lens.image.theta_max_rad;
  return rig;
}

void print_calibration(const OcamCalibration& calibration) {
  const ImageRig& image = calibration.camera.image;
  fmt::print("lens        polynomial, images of {} x {}, known up to {:.3f} rad from the axis\n", *image.width_px,
             *image.height_px, *image.theta_max_rad);
  fmt::print("centre      camera.centre_px = [{:.2f}, {:.2f}], camera.beta = {:.5f}\n", image.centre_px->at(0),
             image.centre_px->at(1), image.beta);
  fmt::print("left out    a shear that moves no pixel by more than {:.2f} px\n", calibration.left_out_px);
  fmt::print(
      "heading     cannot tell: the file does not say where the robot's heading is in the image, or that the lens "
      "looks "
      "straight up; azimuth_direction and azimuth_offset_rad stay as they were: azimuth calibrate heading\n");
}

}  // namespace

void calibrate_by_ocam(const OcamOptions& options) {
  if (!options.outputs.picture.empty()) refuse("--picture: with --ocam there is no image to draw on");
  const OcamCalibration calibration = calibration_or_refuse(options.calibration);
  const ImageRig& image = calibration.camera.image;
  const FrameFormat format{
      .pixels = PixelFormat::gray8, .width_px = *image.width_px, .height_px = *image.height_px, .stride_bytes = 0};
  const Rig rig = with_lens(rig_of_fisheye_or_refuse(options.rig, format), calibration.camera);
  print_calibration(calibration);
  if (!options.outputs.rig.empty())
    write_rig(rig,
              "# The lens of " + options.calibration.filename().string() +
                  ", which says nothing of azimuth_direction, azimuth_offset_rad, front_end\n"
                  "# and [odometry]: check these.\n",
              options.outputs.rig);
}

}  // namespace azimuth
