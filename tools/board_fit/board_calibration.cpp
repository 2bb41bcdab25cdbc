#include "tools/board_fit/board_calibration.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

#include "slam/camera/make_camera.hpp"
#include "slam/perception/image/gray.hpp"

namespace azimuth {
namespace {

using Path = std::filesystem::path;

constexpr std::size_t kLookedAtAgain = 6;  // number of images without the board that are searched for any other board
constexpr std::size_t kLeastBoards = 5;
constexpr double kLeastReach = 0.6;       // corners must reach this fraction of the image circle's radius
constexpr double kMostMustFitLens = 0.8;  // least share of corners that fit
// Largest acceptable standard deviations of the centre, of radii, and of the focal length (relative).
constexpr double kMostCentre_px = 2.0;
constexpr double kMostRadius_px = 4.0;
constexpr double kMostFocal = 0.02;
constexpr double kBeyond_rad = 0.02;  // the lens is valid up to the largest observed angle plus this

FileResult<ImageFile> grey_image(const Path& file) {
  const FileResult<ImageFile> image = read_image(file);
  if (!image) return failure(image.error());
  return in_grey(*image);
}

std::string size_of(const FrameFormat& format) { return fmt::format("{} x {}", format.width_px, format.height_px); }

/// The board with the larger number as columns, since the orientation does not matter here.
Chessboard lying(const Chessboard& board) {
  return {.columns = std::max(board.columns, board.rows), .rows = std::min(board.columns, board.rows)};
}

Chessboard seen_most_often(const std::vector<Chessboard>& boards) {
  Chessboard best;
  std::ptrdiff_t most = 0;
  for (const Chessboard& each : boards)
    if (const auto times = std::count(boards.begin(), boards.end(), each); times > most) {
      most = times;
      best = each;
    }
  return best;
}

Chessboard other_board(const std::vector<Path>& images, const Chessboard& board) {
  std::vector<Chessboard> others;
  for (std::size_t i = 0; i < images.size(); i += 1 + images.size() / kLookedAtAgain) {
    const FileResult<ImageFile> image = grey_image(images[i]);
    const auto any = image ? any_chessboard(image->view()) : std::nullopt;
    if (any && !(lying(*any) == lying({.columns = board.columns, .rows = board.rows}))) others.push_back(lying(*any));
  }
  return seen_most_often(others);
}

std::string words(const Chessboard& board) { return fmt::format("{}x{}", board.columns, board.rows); }

std::string named(const std::vector<Path>& files) {
  constexpr std::size_t kMost = 3;
  std::string text;
  for (std::size_t i = 0; i < files.size() && i < kMost; ++i)
    text += (i == 0 ? "" : ", ") + files[i].filename().string();
  return files.size() > kMost ? text + ", ..." : text;
}

std::string why_too_few(const Chessboard& board, const SeenBoards& seen) {
  if (seen.sightings.size() >= kLeastBoards) return {};
  const std::string found = fmt::format("a chessboard of {} inner corners was found in {} of {} images", words(board),
                                        seen.sightings.size(), seen.images.size());
  if (seen.other.columns > 0)
    return fmt::format(
        "{}, and one of {} in others: --chessboard counts corners inside, where four squares meet, one less each way "
        "than there are squares",
        found, words(seen.other));
  if (seen.without.empty())
    return fmt::format("{}, and it takes {} or more: at different places of the image, tilted differently", found,
                       kLeastBoards);
  return fmt::format(
      "{}, and it takes {} or more: the whole board must be seen, sharp, with a white edge all round; not found in {}",
      found, kLeastBoards, named(seen.without));
}

Lens equidistant(const CameraRig& rig, double theta_rad, double unit_px) {
  CameraRig camera = rig;
  camera.model = EquidistantRig{unit_px / theta_rad};
  camera.image.theta_max_rad = theta_rad;
  std::string problem;
  return *lens_of(camera, unit_px, problem);
}

std::vector<Lens> starts_of(const CameraRig& rig, double unit_px, std::optional<double> field_of_view_rad) {
  if (field_of_view_rad) return {equidistant(rig, 0.5 * *field_of_view_rad, unit_px)};
  std::vector<Lens> starts;
  std::string problem;
  if (looks_up(rig.model))
    if (const auto lens = lens_of(rig, unit_px, problem)) starts.push_back(*lens);
  constexpr double kNarrowest_rad = 0.35, kWidest_rad = 2.3, kRatio = 1.1;
  for (double theta = kNarrowest_rad; theta < kWidest_rad; theta *= kRatio)
    starts.push_back(equidistant(rig, theta, unit_px));
  return starts;
}

std::string why_cannot_tell(const BoardCalibration& found) {
  const BoardSolution& solution = found.solution;
  if (solution.fitting() < kMostMustFitLens)
    return fmt::format(
        "only {:.0f} % of the corners fit any lens: the board may not be flat, images not of one lens and focus, or "
        "the lens of a kind that a polynomial does not describe",
        100.0 * solution.fitting());
  if (found.reach_px < kLeastReach * found.rim_px)
    return fmt::format(
        "the board is seen in the image's middle only, up to {:.0f} px from the centre of a circle of {:.0f} px, which "
        "tells nothing of the lens's rim (camera.polynomial_a2 to a4): hold it near the rim all round; where the "
        "circle is smaller, camera.mask_outer_px says so",
        found.reach_px, found.rim_px);
  const double focal = std::sqrt(solution.covariance(2, 2)) / std::abs(solution.lens.c[0]);
  if (!(focal < kMostFocal))
    return fmt::format(
        "how long the lens is (camera.polynomial_a0) is known to +- {:.0f} % only: boards that face the lens squarely "
        "do not tell it from how far off they are, so tilt the board by 30 degrees or more, each time another way",
        100.0 * focal);
  const double centre_px = std::sqrt(std::max(solution.covariance(0, 0), solution.covariance(1, 1)));
  if (!(centre_px < kMostCentre_px))
    return fmt::format(
        "the lens's centre (camera.centre_px) is known to +- {:.1f} px only: hold the board all round the centre",
        centre_px);
  for (double theta = 0.2; theta < found.theta_seen_rad; theta += 0.1)
    if (const double sigma_px = sigma_radius_px(solution.lens, solution.covariance, theta);
        !(sigma_px < kMostRadius_px))
      return fmt::format(
          "what is {:.0f} degrees from the axis is seen at a radius known to +- {:.1f} px only (camera.polynomial_a0 "
          "to "
          "a4): more images, at more places",
          theta * 180.0 / kPi, sigma_px);
  return {};
}

void measure_reach(const std::vector<BoardSighting>& sightings, BoardCalibration& found) {
  std::size_t corner = 0;
  for (const BoardSighting& each : sightings)
    for (const Pixel& pixel : each.corners)
      if (found.solution.fits[corner++])
        found.reach_px = std::max(found.reach_px, found.solution.lens.axes.polar(pixel).radius_px);
  found.theta_seen_rad = found.solution.lens.theta_rad(found.reach_px);
}

}  // namespace

ImageFile in_grey(const ImageFile& image) {
  const ImageView view = image.view();
  const int width_px = view.format.width_px;
  ImageFile grey{packed_format(PixelFormat::gray8, width_px, view.format.height_px), {}};
  grey.bytes.resize(grey.format.bytes());
  for (int row = 0; row < view.format.height_px; ++row)
    gray_row(view, row, 0, width_px,
             reinterpret_cast<std::uint8_t*>(grey.bytes.data()) + as_size(row) * as_size(width_px));
  return grey;
}

FileResult<SeenBoards> look_for_boards(const std::vector<Path>& images, const Chessboard& board) {
  SeenBoards seen;
  seen.images = images;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const FileResult<ImageFile> image = grey_image(images[i]);
    if (!image) return failure(image.error());
    if (i == 0) seen.format = image->format;
    if (!(image->format == seen.format))
      return failure(FileError{images[i].string(), 0,
                               fmt::format("is {} pixels large, and the images before it {}: images of one size are of "
                                           "one lens, so give each size a run of its own",
                                           size_of(image->format), size_of(seen.format))});
    if (auto corners = find_chessboard(image->view(), board))
      seen.sightings.push_back({i, *std::move(corners)});
    else
      seen.without.push_back(images[i]);
  }
  if (seen.sightings.size() < seen.without.size()) seen.other = other_board(seen.without, board);
  return seen;
}

std::optional<BoardCalibration> calibrate_by_boards(const Chessboard& board, const SeenBoards& seen, const Rig& rig,
                                                    std::optional<double> field_of_view_rad, std::string& problem) {
  problem = why_too_few(board, seen);
  if (!problem.empty()) return std::nullopt;
  BoardCalibration found;
  found.rim_px = image_radius_px(rig.camera.image);
  const auto start = board_start(starts_of(rig.camera, found.rim_px, field_of_view_rad), board, seen.sightings);
  auto solution = start ? fit_boards(board, seen.sightings, *start) : std::nullopt;
  if (!solution) {
    problem = "these boards do not determine the lens: tilt the board differently, and hold it near the rim all round";
    return std::nullopt;
  }
  found.solution = *std::move(solution);
  measure_reach(seen.sightings, found);
  problem = why_cannot_tell(found);
  if (!problem.empty()) return std::nullopt;
  const Lens& lens = found.solution.lens;
  found.theta_max_rad = theta_max_rad(lens, std::min(found.theta_seen_rad + kBeyond_rad, kPi - 0.01));
  found.rig = rig;
  found.rig.camera = with_lens(rig.camera, lens, found.theta_max_rad);
  return found;
}

Rig unknown_fisheye(const FrameFormat& format) {
  Rig rig;
  rig.front_end = FrontEnd::lamps;
  rig.camera.model = PolynomialRig{};
  rig.camera.image.width_px = format.width_px;
  rig.camera.image.height_px = format.height_px;
  rig.camera.image.azimuth_direction = 1;  // as in config/rigs/ceiling-fisheye.toml
  rig.camera.image.azimuth_offset_rad = 0.5 * kPi;
  return rig;
}

}  // namespace azimuth
