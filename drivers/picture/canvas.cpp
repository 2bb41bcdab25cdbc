#include "drivers/picture/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace azimuth {
namespace {

// Positions in fractions of a pixel, so that thin lines are smooth.
constexpr int kFractionBits = 4;
constexpr double kFraction = 1 << kFractionBits;
constexpr double kFarthest_px = 1e5;  // Beyond any picture, but within OpenCV's integers

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kLabelSize = 0.38, kCaptionSize = 0.5;
constexpr int kCaptionLine_px = 20;

cv::Scalar scalar(const PictureColour& colour) { return {double(colour[0]), double(colour[1]), double(colour[2])}; }

double within_reach(double coordinate_px) {
  return std::isfinite(coordinate_px) ? std::clamp(coordinate_px, -kFarthest_px, kFarthest_px) : kFarthest_px;
}

cv::Point fine(const Pixel& pixel) {
  const auto part = [](double px) {
    return static_cast<int>(std::lround((within_reach(px) + Canvas::kMargin_px) * kFraction));
  };
  return {part(pixel.x()), part(pixel.y())};
}

cv::Point coarse(const Pixel& pixel) {
  const auto whole = [](double px) { return static_cast<int>(std::lround(within_reach(px))) + Canvas::kMargin_px; };
  return {whole(pixel.x()), whole(pixel.y())};
}

}  // namespace

void Canvas::begin(int width_px, int height_px) {
  picture_.create(height_px + 2 * kMargin_px, width_px + 2 * kMargin_px, CV_8UC3);
  picture_.setTo(cv::Scalar::all(0));
}

cv::Mat Canvas::image() const {
  return picture_(cv::Rect(kMargin_px, kMargin_px, picture_.cols - 2 * kMargin_px, picture_.rows - 2 * kMargin_px));
}

void Canvas::line(const Pixel& from, const Pixel& to, const PictureColour& colour, int thickness_px) {
  cv::line(picture_, fine(from), fine(to), scalar(colour), thickness_px, cv::LINE_AA, kFractionBits);
}

void Canvas::polyline(const std::vector<Pixel>& points, bool closed, const PictureColour& colour, int thickness_px) {
  std::vector<cv::Point> corners(points.size());
  std::transform(points.begin(), points.end(), corners.begin(), fine);
  cv::polylines(picture_, corners, closed, scalar(colour), thickness_px, cv::LINE_AA, kFractionBits);
}

void Canvas::circle(const Pixel& centre, double radius_px, const PictureColour& colour) {
  const int radius = static_cast<int>(std::lround(within_reach(radius_px) * kFraction));
  cv::circle(picture_, fine(centre), std::max(radius, 1), scalar(colour), 1, cv::LINE_AA, kFractionBits);
}

Pixel Canvas::label_size_px(const std::string& text) {
  const cv::Size size = cv::getTextSize(text, kFont, kLabelSize, 1, nullptr);
  return {size.width, size.height};
}

void Canvas::label(const Pixel& middle, const std::string& text, const PictureColour& colour) {
  const cv::Size size = cv::getTextSize(text, kFont, kLabelSize, 1, nullptr);
  const cv::Point corner = coarse(middle) + cv::Point(-size.width / 2, size.height / 2);
  cv::putText(picture_, text, corner, kFont, kLabelSize, scalar(colour), 1, cv::LINE_AA);
}

void Canvas::caption(int line, const std::string& text, const PictureColour& colour) {
  const cv::Point corner(8, kCaptionLine_px * (line + 1));
  cv::putText(picture_, text, corner, kFont, kCaptionSize, {0, 0, 0}, 3, cv::LINE_AA);  // legible outline
  cv::putText(picture_, text, corner, kFont, kCaptionSize, scalar(colour), 1, cv::LINE_AA);
}

}  // namespace azimuth
