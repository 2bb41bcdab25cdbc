#include "tools/board_fit/chessboard.hpp"

#include <algorithm>
#include <cassert>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace azimuth {
namespace {

/// The const_cast is necessary because cv::Mat takes no const pointer; OpenCV does not write to this matrix.
cv::Mat matrix_of(const ImageView& image) {
  assert(image.format.pixels == PixelFormat::gray8);
  auto* const first = const_cast<std::byte*>(image.bytes.data());
  return {image.format.height_px, image.format.width_px, CV_8UC1, first,
          static_cast<std::size_t>(image.format.stride_bytes)};
}

std::vector<Pixel> pixels_of(const std::vector<cv::Point2f>& corners) {
  std::vector<Pixel> pixels;
  for (const cv::Point2f& each : corners) pixels.emplace_back(each.x, each.y);
  return pixels;
}

/// Least distance between neighbouring corners of a row.
double least_spacing_px(const std::vector<cv::Point2f>& corners, int columns) {
  double least_px = 1e9;
  for (std::size_t i = 1; i < corners.size(); ++i)
    if (i % as_size(columns) != 0) least_px = std::min(least_px, cv::norm(corners[i] - corners[i - 1]));
  for (std::size_t i = as_size(columns); i < corners.size(); ++i)
    least_px = std::min(least_px, cv::norm(corners[i] - corners[i - as_size(columns)]));
  return least_px;
}

/// Refines corners to subpixel accuracy. The windows are small enough to contain no other corner and little distortion.
void refine(const cv::Mat& image, int columns, std::vector<cv::Point2f>& corners) {
  const int half_px = std::clamp(static_cast<int>(0.3 * least_spacing_px(corners, columns)), 2, 5);
  const cv::TermCriteria until(cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 60, 1e-3);
  cv::cornerSubPix(image, corners, {half_px, half_px}, {-1, -1}, until);
}

}  // namespace

/// Tries two detectors of OpenCV in turn. The one that follows squares copes with strong distortion; the one that
/// searches for corners finds a few more boards, mainly in poor light.
std::optional<std::vector<Pixel>> find_chessboard(const ImageView& image, const Chessboard& board) {
  const cv::Mat matrix = matrix_of(image);
  const cv::Size size(board.columns, board.rows);
  std::vector<cv::Point2f> corners;
  if (!cv::findChessboardCorners(matrix, size, corners, cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE) &&
      !cv::findChessboardCornersSB(matrix, size, corners, cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_EXHAUSTIVE))
    return std::nullopt;
  if (corners.size() != board.corners()) return std::nullopt;
  refine(matrix, board.columns, corners);
  return pixels_of(corners);
}

std::optional<Chessboard> any_chessboard(const ImageView& image) {
  constexpr int kLeast = 3;
  std::vector<cv::Point2f> corners;
  cv::Mat found;
  const int how = cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_EXHAUSTIVE | cv::CALIB_CB_LARGER;
  if (!cv::findChessboardCornersSB(matrix_of(image), {kLeast, kLeast}, corners, how, found)) return std::nullopt;
  return Chessboard{.columns = found.cols, .rows = found.rows};
}

}  // namespace azimuth
