// azimuth calibrate fisheye: finds the lens from lamps seen on a drive, from images of a chessboard, or from another
// program's calibration.

#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "drivers/camera/run_images.hpp"
#include "settings/configuration.hpp"
#include "settings/file_text.hpp"
#include "settings/ocam_calibration.hpp"
#include "settings/rig.hpp"
#include "slam/camera/make_camera.hpp"
#include "tools/azimuth/calibrate_chessboard.hpp"
#include "tools/azimuth/calibrate_optics.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/azimuth/output_path.hpp"
#include "tools/azimuth/recorded_drive.hpp"
#include "tools/lens_fit/fisheye_calibration.hpp"
#include "tools/lens_fit/residual_picture.hpp"

namespace azimuth {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct FisheyeOptions {
  std::filesystem::path run, config, ocam;
  ChessboardOptions chessboard;
  LogOptions log;
  std::vector<std::string> overrides;
  FisheyeRequest request;
  std::optional<double> field_of_view_deg;
  CalibrationOutputs outputs;
};

double sigma(const LensSolution& solution, int number) { return std::sqrt(solution.covariance(number, number)); }

void print_found(const FisheyeCalibration& found, const FisheyeRequest& request) {
  const LensSolution& solution = found.solution;
  const Lens& lens = solution.lens;
  print_lens(lens, solution.of_lens(), found.theta_seen_rad, found.height_known);
  fmt::print("reach       camera.theta_max_rad = {:.3f}: lamps were seen up to {:.3f}\n", found.theta_max_rad,
             found.theta_seen_rad);
  fmt::print("heading     camera.azimuth_offset_rad = {:.4f} +- {:.4f}\n", lens.axes.azimuth_offset_rad,
             sigma(solution, 6));
  if (found.tilt_found)
    fmt::print("tilt        camera.roll_rad = {:.4f} +- {:.4f}, camera.pitch_rad = {:.4f} +- {:.4f}\n",
               lens.tilt.roll_rad, sigma(solution, kRoll), lens.tilt.pitch_rad, sigma(solution, kPitch));
  else
    fmt::print("tilt        as it was: lamps do not contradict that\n");
  if (found.height_known) {
    fmt::print(
        "height      lamps {:.2f} m above the camera, as measured to +- {:g} m; the lens's scale is no better than "
        "this and the odometry's scale of distances\n",
        solution.lamp_height_m, request.sigma_lamp_height_m);
  } else {
    fmt::print(
        "height      cannot tell: images do not tell how high lamps are from how long the lens is, so "
        "camera.polynomial_a0 "
        "stays; with it they are {:.2f} +- {:.2f} m above the camera; --lamp-height METRES tells both\n",
        solution.lamp_height_m, sigma(solution, kLampHeight));
  }
  fmt::print(
      "odometry    distances off by {:+.2f} +- {:.2f} %, turns by {:+.2f} +- {:.2f} %: not written, see azimuth "
      "calibrate odometry\n",
      100.0 * solution.scale_distance_error, 100.0 * sigma(solution, kScaleDistance), 100.0 * solution.scale_turn_error,
      100.0 * sigma(solution, kScaleTurn));
}

void calibrate_fisheye_by_lamps(FisheyeOptions options) {
  if (options.chessboard.images.size() != 1)
    refuse("one RUN at a time, unless images of a chessboard are given: --chessboard COLUMNSxROWS");
  options.run = options.chessboard.images.front();
  const Run run = load_run_or_refuse(options.run, options.log);
  const FileResult<Rig> rig = read_rig(run.rig_toml, run.rig_file);
  if (!rig) refuse(rig.error());
  const FileResult<Configuration> configuration = read_configuration_file(options.config, options.overrides);
  if (!configuration) refuse(configuration.error());
  std::string problem;
  const auto found = calibrate_fisheye(run, *rig, configuration->perception.lamps, options.request, problem);
  if (!found) refuse(options.run.string() + ": " + problem);
  print_fisheye(run, *found, options.request);
  if (!options.outputs.rig.empty())
    write_rig(found->rig, "# Made by azimuth calibrate fisheye from " + run.name + ".\n", options.outputs.rig);
  if (options.outputs.picture.empty()) return;
  if (const auto unwritten = fisheye_picture(run, *found).write(options.outputs.picture))
    fail(options.outputs.picture.string() + ": " + *unwritten);
}

struct OcamOptions {
  std::filesystem::path calibration;  ///< calib_results.txt of OCamCalib
  std::filesystem::path rig;          ///< empty: the user fills in everything but the lens
  CalibrationOutputs outputs;
};

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

/// --ocam: takes the lens from a calibration by OCamCalib.
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

void calibrate_fisheye_of(FisheyeOptions options) {
  if (!options.outputs.picture.empty() && plot_format(options.outputs.picture) != PlotFormat::png)
    refuse(options.outputs.picture.string() + ": the name of a picture of pixels must end in .png");
  check_outputs(options.outputs);
  if (!options.ocam.empty())
    return calibrate_by_ocam({.calibration = options.ocam, .rig = options.log.rig_file, .outputs = options.outputs});
  if (options.chessboard.images.empty()) refuse("RUN is required");
  if (options.field_of_view_deg) options.request.field_of_view_rad = *options.field_of_view_deg * kDegree;
  if (options.chessboard.board.empty()) return calibrate_fisheye_by_lamps(std::move(options));
  options.chessboard.rig = options.log.rig_file;
  options.chessboard.field_of_view_rad = options.request.field_of_view_rad;
  options.chessboard.outputs = options.outputs;
  calibrate_by_chessboard(options.chessboard);
}

void add_chessboard_options(CLI::App& command, ChessboardOptions& options) {
  CLI::Option* board = command
                           .add_option("--chessboard", options.board,
                                       "Take the lens from images of a flat chessboard with this number of inner "
                                       "corners, where four squares meet: one less each way than there are squares")
                           ->type_name("COLUMNSxROWS");
  command
      .add_option("--square", options.square_m,
                  "Side of a square, for printing how far off the boards were; the lens does not need it")
      ->type_name("METRES")
      ->check(CLI::Range(1e-3, 10.0))
      ->needs(board);
  command.add_option("--most-images", options.most_images, "Number of images to look at, evenly spread")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str()
      ->needs(board);
}

}  // namespace

void print_fisheye(const Run& run, const FisheyeCalibration& found, const FisheyeRequest& request) {
  const LensSolution& solution = found.solution;
  fmt::print("drive       {} images, {} lamps, {} sightings, {:.0f} % of them fit\n", run.frames.size(),
             solution.lamps.size(), found.drive.sightings.size(), 100.0 * solution.fitting());
  fmt::print(
      "residual    {:.3f} px (root of the mean square of those that fit), {:.1f} times what was claimed of lamps\n",
      solution.rms_px(), std::sqrt(solution.unit_variance));
  print_found(found, request);
}

PlotCanvas fisheye_picture(const Run& run, const FisheyeCalibration& found) {
  RunImages images(run);
  const ImageView image = images.pixels(run.frames.size() / 2, PixelFormat::gray8);
  if (image.bytes.empty()) fail(images.problem());
  return lens_picture(image, found.drive, found.solution);
}

void add_calibrate_fisheye_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "fisheye", "Find a fisheye's centre and lens from lamps on a drive, a chessboard or OCamCalib's file");
  const auto options = std::make_shared<FisheyeOptions>();
  CLI::Option* const run =
      command->add_option("RUN", options->chessboard.images,
                          std::string(kRunHelp) +
                              " with images of a camera that looks up; with --chessboard: images (JPEG, PNG, PGM, "
                              "PPM), folders of images or run folders; not with --ocam");
  command
      ->add_option(
          "--ocam", options->ocam,
          "Take the lens from this calibration by OCamCalib (calib_results.txt), and everything else from --rig")
      ->type_name("FILE")
      ->excludes(run);
  add_chessboard_options(*command, options->chessboard);
  add_log_options(*command, options->log);
  command->add_option("--config", options->config, "azimuth.toml whose table [lamps] says what a lamp is");
  command->add_option("--set", options->overrides, "Override a setting, e.g. lamps.min_elevation_rad=0.3")
      ->type_name("KEY=VALUE");
  command
      ->add_option(
          "--lamp-height", options->request.lamp_height_m,
          "Measured height of the lamps above the floor; without it the scale of the rig's lens is taken as right")
      ->type_name("METRES")
      ->check(CLI::Range(0.1, 100.0));
  command
      ->add_option("--lamp-height-sigma", options->request.sigma_lamp_height_m,
                   "Standard deviation of the height that --lamp-height gives")
      ->type_name("METRES")
      ->check(CLI::Range(1e-4, 10.0))
      ->capture_default_str();
  command
      ->add_option("--lamp-spread", options->request.sigma_one_lamp_m,
                   "Standard deviation by which single lamps hang higher or lower")
      ->type_name("METRES")
      ->check(CLI::Range(1e-4, 10.0))
      ->capture_default_str();
  command
      ->add_option(
          "--field-of-view", options->field_of_view_deg,
          "Begin from an equidistant lens with this angle of view within the image's circle, not from the rig's lens")
      ->type_name("DEGREES")
      ->check(CLI::Range(60.0, 280.0));
  command->add_option("--out", options->outputs.rig, "Write a rig.toml: the run's rig with the lens that was found");
  command->add_flag("--force", options->outputs.force, "Replace the file of --out if it exists");
  command->add_option("--picture", options->outputs.picture, "Draw centre, circles and residuals on an image, as PNG");
  command->footer("Exit codes: 0 done, 1 a file could not be written, 2 wrong use or input, or the drive cannot tell.");
  command->callback([options] { calibrate_fisheye_of(*options); });
}

}  // namespace azimuth
