#include "tools/board_fit/seen_boards.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "slam/perception/image/gray.hpp"

namespace azimuth {
namespace {

using Path = std::filesystem::path;

constexpr std::size_t kLookedAtAgain = 6;  // number of images without the board that are searched for any other board

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

}  // namespace azimuth
