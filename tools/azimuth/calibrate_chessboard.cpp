#include "tools/azimuth/calibrate_chessboard.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

#include "settings/rig.hpp"
#include "slam/camera/make_camera.hpp"
#include "slam/geometry/angle.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/board_fit/board_calibration.hpp"
#include "tools/board_fit/board_picture.hpp"
#include "tools/calibrate/image_files.hpp"

namespace azimuth {
namespace {

Chessboard board_or_refuse(const ChessboardOptions& options) {
  constexpr int kLeast = 3, kMost = 60;
  Chessboard board{.columns = 0, .rows = 0, .square_m = options.square_m.value_or(1.0)};
  const char *const end = options.board.data() + options.board.size(), *next = options.board.data();
  const auto number = [&](int& into) {
    const auto [rest, error] = std::from_chars(next, end, into);
    next = rest;
    return error == std::errc{} && into >= kLeast && into <= kMost;
  };
  const auto times = [&] { return next != end && (*next == 'x' || *next == 'X') && ++next != nullptr; };
  if (number(board.columns) && times() && number(board.rows) && next == end) return board;
  refuse(fmt::format("--chessboard {}: must be COLUMNSxROWS, each {} to {}: inner corners, where four squares meet",
                     options.board, kLeast, kMost));
}

/// The rig file of the option, else the rig file of a run folder.
std::filesystem::path rig_file(const ChessboardOptions& options) {
  constexpr const char* kOfRun = "rig.toml";
  const bool is_there = options.rig.empty() && std::filesystem::exists(options.images.front() / kOfRun);
  return is_there ? options.images.front() / kOfRun : options.rig;
}

void print_images(const SeenBoards& seen) {
  fmt::print("images      {}, a board found in {} of them\n", seen.images.size(), seen.sightings.size());
  for (const std::filesystem::path& file : seen.without) fmt::print("no board    {}\n", shown(file));
}

void print_boards(const Chessboard& board, const ChessboardOptions& options, const BoardCalibration& found) {
  const BoardSolution& solution = found.solution;
  double nearest = 1e9, farthest = 0.0;
  for (const Eigen::Isometry3d& each : solution.T_camera_board) {
    nearest = std::min(nearest, each.translation().norm());
    farthest = std::max(farthest, each.translation().norm());
  }
  fmt::print(
      "residual    {:.3f} px (root of the mean square of the {:.1f} % of {} corners that fit), {:.3f} px along u and "
      "v\n",
      solution.rms_px(), 100.0 * solution.fitting(), board.corners() * solution.T_camera_board.size(),
      solution.sigma_px);
  fmt::print("boards      {:.2f} to {:.2f} {} from the lens\n", nearest, farthest, options.square_m ? "m" : "squares");
}

void print_reach(const BoardCalibration& found) {
  fmt::print(
      "reach       camera.theta_max_rad = {:.3f}: corners were seen up to {:.3f}, {:.0f} of {:.0f} px from the "
      "centre\n",
      found.theta_max_rad, found.theta_seen_rad, found.reach_px, found.rim_px);
  fmt::print(
      "heading     cannot tell: no board says where the robot's heading is in the image, or that the lens looks "
      "straight "
      "up; azimuth_direction and azimuth_offset_rad stay as they were: azimuth calibrate heading, or fisheye on a "
      "drive "
      "below lamps\n");
}

void draw(const SeenBoards& seen, const Chessboard& board, const BoardSolution& solution,
          const std::filesystem::path& file) {
  const FileResult<ImageFile> image = read_image(seen.images[seen.sightings.front().image]);
  if (!image) refuse(image.error());
  PlotCanvas picture = board_picture(in_grey(*image).view(), board, seen.sightings, solution);
  if (const auto problem = picture.write(file)) fail(file.string() + ": " + *problem);
}

}  // namespace

Rig rig_of_fisheye_or_refuse(const std::filesystem::path& file, const FrameFormat& format) {
  if (file.empty()) return unknown_fisheye(format);
  FileResult<Rig> rig = read_rig_file(file);
  if (!rig) refuse(rig.error());
  if (!is_size_of(format, rig->camera.image))
    refuse(fmt::format("{}: is for images of another size: these are {} x {}", file.string(), format.width_px,
                       format.height_px));
  if (takes_images(rig->camera.model) && !looks_up(rig->camera.model))
    refuse(fmt::format("{}: camera.model \"{}\" is of a mirror, which azimuth calibrate mirror is for", file.string(),
                       name(rig->camera.model)));
  rig->camera.image.width_px = format.width_px;
  rig->camera.image.height_px = format.height_px;
  return *std::move(rig);
}

void calibrate_by_chessboard(const ChessboardOptions& options) {
  const Chessboard board = board_or_refuse(options);
  const FileResult<std::vector<std::filesystem::path>> files = image_files(options.images, options.most_images);
  if (!files) refuse(files.error());
  const FileResult<SeenBoards> seen = look_for_boards(*files, board);
  if (!seen) refuse(seen.error());
  const Rig rig = rig_of_fisheye_or_refuse(rig_file(options), seen->format);
  print_images(*seen);
  std::string problem;
  const auto found = calibrate_by_boards(board, *seen, rig, options.field_of_view_rad, problem);
  if (!found) refuse(options.images.front().string() + ": " + problem);
  print_boards(board, options, *found);
  print_lens(found->solution.lens, found->solution.covariance, found->theta_seen_rad, true);
  print_reach(*found);
  if (!options.outputs.rig.empty())
    write_rig(found->rig,
              fmt::format("# Made by azimuth calibrate fisheye from {} images of a chessboard, which say nothing of\n"
                          "# azimuth_direction, azimuth_offset_rad, front_end and [odometry]: check these.\n",
                          seen->sightings.size()),
              options.outputs.rig);
  if (!options.outputs.picture.empty()) draw(*seen, board, found->solution, options.outputs.picture);
}

void print_lens(const Lens& lens, const LensCovariance& covariance, double seen_to_rad, bool scale_known) {
  const auto sigma = [&](int number) { return std::sqrt(covariance(number, number)); };
  fmt::print("centre      camera.centre_px = ({:.2f}, {:.2f}) +- ({:.2f}, {:.2f})\n", lens.axes.centre_px.x(),
             lens.axes.centre_px.y(), sigma(0), sigma(1));
  const auto a = lens.coefficients();
  constexpr std::array<int, 4> kOrders{0, 2, 3, 4};
  for (int k = 0; k < 4; ++k) {
    const int order = kOrders[as_size(k)];
    if (k == 0 && !scale_known) {
      fmt::print("lens        camera.polynomial_a0 = {:.4f} as the lens began: see height\n", a[0]);
      continue;
    }
    fmt::print("lens        camera.polynomial_a{} = {:.4g} +- {:.2g}\n", order, a[as_size(order)],
               sigma(2 + k) * std::pow(lens.radius_px, 1 - order));
  }
  fmt::print("lens        camera.polynomial_a1 = 0: held, since a smooth lens has none\n");
  for (const double degrees : {15.0, 30.0, 45.0, 60.0, 75.0, 90.0})
    if (const double theta_rad = degrees_to_rad(degrees); theta_rad <= seen_to_rad)
      fmt::print("radius      {:.2f} +- {:.2f} px at {:.0f} degrees from the axis\n", radius_px(lens, theta_rad),
                 sigma_radius_px(lens, covariance, theta_rad), degrees);
}

}  // namespace azimuth
