#include "slam/perception/calibration/edge_map.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace azimuth {
namespace {

constexpr double kSmoothing_px = 1.0;  // Smoothing of the reduced image before the edge detection
constexpr double kSpread_px = 1.2;     // Blur of edges, so that a ring need not meet them exactly
constexpr float kFaintest = 3.0F;      // Slope [levels/px] that noise causes after smoothing

struct Gradient {
  cv::Mat u, v, size;  // CV_32FC1
};

Gradient gradient(const cv::Mat& gray, double scale) {
  cv::Mat reduced;
  cv::resize(gray, reduced, {}, scale, scale, cv::INTER_AREA);
  reduced.convertTo(reduced, CV_32F);
  cv::GaussianBlur(reduced, reduced, {}, kSmoothing_px);
  Gradient slope;
  cv::Sobel(reduced, slope.u, CV_32F, 1, 0, 3, 1.0 / 8.0);
  cv::Sobel(reduced, slope.v, CV_32F, 0, 1, 3, 1.0 / 8.0);
  cv::magnitude(slope.u, slope.v, slope.size);
  return slope;
}

/// The slope with weight 1/2. Greater slopes gain little, so that a lamp does not outweigh the rim. It is the median
/// slope: in an image full of noise or texture only steeper edges stand out.
float half_slope(const cv::Mat& size) {
  std::vector<float> all(size.begin<float>(), size.end<float>());
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return std::max(kFaintest, *middle);
}

/// Whether the pixel is a local maximum along the slope, which makes all edges thin, steep ones too.
bool is_ridge(const Gradient& slope, int u, int v) {
  constexpr float kTan = 0.41421356F;  // Of 22.5 degrees
  const float du = slope.u.at<float>(v, u), dv = slope.v.at<float>(v, u), size = slope.size.at<float>(v, u);
  const bool flat = std::abs(dv) < kTan * std::abs(du), steep = std::abs(du) < kTan * std::abs(dv);
  const int step_u = steep ? 0 : 1;
  const int step_v = flat ? 0 : (steep || du * dv > 0.0F ? 1 : -1);
  return size > 0.0F && size >= slope.size.at<float>(v + step_v, u + step_u) &&
         size > slope.size.at<float>(v - step_v, u - step_u);
}

}  // namespace

void EdgeMapBuilder::add(const cv::Mat& gray) {
  const Gradient slope = gradient(gray, scale_);
  if (images_++ == 0) {
    normals_ = cv::Mat::zeros(slope.size.size(), CV_32FC2);
    detail_ = cv::Mat::zeros(slope.size.size(), CV_32FC1);
  }
  const float half = half_slope(slope.size);
  for (int v = 1; v + 1 < slope.size.rows; ++v) {
    for (int u = 1; u + 1 < slope.size.cols; ++u) {
      const float du = slope.u.at<float>(v, u), dv = slope.v.at<float>(v, u), size = slope.size.at<float>(v, u);
      const float weight = size / (size + half);
      detail_.at<float>(v, u) += weight;
      if (!is_ridge(slope, u, v)) continue;
      const float per_square = weight / (size * size);  // (du + i dv)^2 / size^2 = exp(2 i t)
      normals_.at<cv::Vec2f>(v, u) += per_square * cv::Vec2f(du * du - dv * dv, 2.0F * du * dv);
    }
  }
}

EdgeMap EdgeMapBuilder::build() const {
  assert(images_ > 0);
  EdgeMap map{.scale = scale_, .normals = {}, .detail = detail_ / images_};
  cv::GaussianBlur(normals_, map.normals, {}, kSpread_px);
  // Along a straight edge, the blur keeps 1 / (sigma sqrt(2 pi)) of each pixel in place. The factor restores 1 for an
  // unbroken steep edge.
  map.normals *= kSpread_px * std::sqrt(2.0 * CV_PI) / images_;
  return map;
}

}  // namespace azimuth
