#include "slam/perception/calibration/edge_circles.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "slam/geometry/index.hpp"
#include "slam/geometry/principal_axes.hpp"

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

constexpr double kLeastInMap = 0.4;  // A smaller part of a rim does not determine its centre

/// Finds the pixel of the map that contains a point. Returns false near the border of the map, where edges are not
/// defined. Truncates instead of rounding, which agrees for all accepted points and is faster in this hot loop.
bool pixel_at(const EdgeMap& map, double u, double v, int& column, int& row) {
  constexpr double kHalf_px = 0.5;
  column = static_cast<int>(u + kHalf_px);
  row = static_cast<int>(v + kHalf_px);
  return column >= 2 && row >= 2 && column < map.detail.cols - 2 && row < map.detail.rows - 2;
}

double mean(const std::vector<double>& values, std::size_t begin, std::size_t end) {
  double sum = 0.0;
  for (std::size_t i = begin; i < end; ++i) sum += values[i];
  return sum / static_cast<double>(end - begin);
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

RayFan::RayFan(int rays) {
  rays_.reserve(as_size(rays));
  for (int i = 0; i < rays; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / rays;
    rays_.push_back({std::cos(angle), std::sin(angle), static_cast<float>(std::cos(2.0 * angle)),
                     static_cast<float>(std::sin(2.0 * angle))});
  }
}

Follows follows(const EdgeMap& map, const ImageCircle& ring, const RayFan::Ray& ray) {
  int column = 0, row = 0;
  if (!pixel_at(map, ring.u + ring.radius * ray.cos, ring.v + ring.radius * ray.sin, column, row)) return {};
  const auto& normal = map.normals.at<cv::Vec2f>(row, column);
  return {true, normal[0] * ray.cos2 + normal[1] * ray.sin2};
}

void read_profile(const EdgeMap& map, const ImageCircle& first, double step, std::size_t rings, const RayFan& fan,
                  RingProfile& out) {
  out.first_radius = first.radius;
  out.step = step;
  out.follows.assign(rings, 0.0);
  out.in_map.assign(rings, 0.0);
  for (std::size_t i = 0; i < rings; ++i) {
    const ImageCircle ring{first.u, first.v, out.radius(i)};
    double sum = 0.0;
    int count = 0;
    for (const RayFan::Ray& ray : fan.rays()) {
      const Follows at = follows(map, ring, ray);
      sum += at.value;
      count += at.in_map;
    }
    if (count > 0) out.follows[i] = sum / count;
    out.in_map[i] = static_cast<double>(count) / static_cast<double>(fan.rays().size());
  }
}

std::size_t rim_reach(double radius, double step) {
  return static_cast<std::size_t>(std::max(2.0, std::round(0.03 * radius / step)));
}

double rim_score(const RingProfile& profile, std::size_t i) {
  const std::size_t reach = rim_reach(profile.radius(i), profile.step);
  if (profile.in_map[i] < kLeastInMap || i < reach) return 0.0;
  const std::size_t outside = std::min(i + 1, profile.follows.size() - 1);
  const std::size_t end = std::min(outside + reach, profile.follows.size());
  const double drop = mean(profile.follows, i - reach, i) - mean(profile.follows, outside, end);
  return (profile.follows[i] + drop) * std::sqrt(profile.in_map[i]);
}

double detail_between(const EdgeMap& map, const ImageCircle& ring, double from, double to) {
  static const RayFan kFan(180);
  constexpr int kCircles = 6;
  double sum = 0.0;
  int count = 0, column = 0, row = 0;
  for (int i = 0; i < kCircles; ++i) {
    const double radius = ring.radius * (from + (to - from) * i / (kCircles - 1));
    for (const RayFan::Ray& ray : kFan.rays()) {
      if (!pixel_at(map, ring.u + radius * ray.cos, ring.v + radius * ray.sin, column, row)) continue;
      sum += map.detail.at<float>(row, column);
      ++count;
    }
  }
  return count < 90 ? std::numeric_limits<double>::quiet_NaN() : sum / count;
}

namespace {

constexpr int kRays = 720;
constexpr float kLeastEdge = 0.3F;

/// An edge point on a ray, by its distance from the current circle.
struct EdgePoint {
  Eigen::Vector3d jacobian;  // d distance / d (u, v, radius)
  double distance = 0.0;
  double weight = 0.0;
};

struct EdgePoints {
  std::vector<EdgePoint> points;
  int in_map = 0;
};

/// Finds the strongest edge on a ray within `window` of the ring. The weight is 0 if there is no clear edge, or if it
/// lies at an end of the window.
EdgePoint strongest(const EdgeMap& map, const ImageCircle& ring, const RayFan::Ray& ray, double window, bool& in_map) {
  constexpr double kStep = 0.5;
  const int steps = static_cast<int>(std::ceil(window / kStep));
  EdgePoint best{{ray.cos, ray.sin, 1.0}, 0.0, 0.0};
  int at = 0;
  for (int i = -steps; i <= steps; ++i) {
    const Follows here = follows(map, {ring.u, ring.v, ring.radius + i * kStep}, ray);
    in_map = in_map && here.in_map;
    if (here.value <= best.weight) continue;
    best.weight = here.value;
    at = i;
  }
  best.distance = at * kStep;
  if (!in_map || best.weight < kLeastEdge || std::abs(at) == steps) best.weight = 0.0;
  return best;
}

EdgePoints edge_points(const EdgeMap& map, const ImageCircle& ring, double window) {
  static const RayFan kFan(kRays);
  EdgePoints edges;
  for (const RayFan::Ray& ray : kFan.rays()) {
    bool in_map = true;
    const EdgePoint point = strongest(map, ring, ray, window, in_map);
    edges.in_map += in_map;
    if (point.weight > 0.0) edges.points.push_back(point);
  }
  return edges;
}

struct Solution {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  // Correction of u, v, radius
  double sigma = 0.0;                               // Of a point's distance
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();

  double residual(const EdgePoint& point) const { return point.distance - point.jacobian.dot(shift); }
};

/// 1.48 times the median absolute residual: a robust estimate of the standard deviation.
double spread(const std::vector<EdgePoint>& points, const Solution& solution) {
  std::vector<double> sizes;
  sizes.reserve(points.size());
  for (const EdgePoint& point : points) sizes.push_back(std::abs(solution.residual(point)));
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return std::max(0.5, 1.48 * *middle);
}

/// Iteratively reweighted least squares with Tukey's robust kernel.
Solution solve(const std::vector<EdgePoint>& points) {
  constexpr int kIterations = 12;
  Solution solution;
  for (int i = 0; i < kIterations; ++i) {
    solution.sigma = spread(points, solution);
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const EdgePoint& point : points) {
      const double relative = solution.residual(point) / (3.0 * solution.sigma);
      const double kept = std::max(0.0, 1.0 - relative * relative);
      const double weight = point.weight * kept * kept;
      normal += weight * point.jacobian * point.jacobian.transpose();
      right += weight * point.distance * point.jacobian;
    }
    normal.diagonal().array() += 1e-9;  // Without points the shift is 0
    solution.shift = normal.ldlt().solve(right);
    solution.information = normal;
  }
  return solution;
}

/// Neighbouring rays read the same pixels, so only points about three pixels apart count as independent.
void add_uncertainty(const Solution& solution, CircleFit& fit) {
  const double rays_per_point = std::max(1.0, 3.0 * kRays / (2.0 * CV_PI * fit.ring.radius));
  const Eigen::Matrix3d covariance = solution.sigma * solution.sigma * rays_per_point * solution.information.inverse();
  fit.sigma_centre = std::sqrt(principal_axes(covariance.topLeftCorner<2, 2>()).eigenvalues.y());
  fit.sigma_radius = std::sqrt(covariance(2, 2));
}

}  // namespace

CircleFit fit_circle(const EdgeMap& map, const ImageCircle& start) {
  constexpr std::array kWindows{0.03, 0.02, 0.015, 0.015, 0.015};  // In multiples of the radius
  constexpr std::size_t kFewest = kRays / 10;
  CircleFit fit;
  fit.ring = start;
  for (const double part : kWindows) {
    const EdgePoints edges = edge_points(map, fit.ring, std::max(2.0, part * fit.ring.radius));
    fit.seen = 0.0;
    if (edges.points.size() < kFewest) return fit;
    const Solution solution = solve(edges.points);
    const double on_circle = 1.5 + 0.004 * fit.ring.radius;
    const auto seen = std::count_if(edges.points.begin(), edges.points.end(), [&](const EdgePoint& point) {
      return std::abs(solution.residual(point)) < on_circle;
    });
    fit.ring.u += solution.shift.x();
    fit.ring.v += solution.shift.y();
    fit.ring.radius += solution.shift.z();
    fit.seen = static_cast<double>(seen) / edges.in_map;
    fit.in_map = static_cast<double>(edges.in_map) / kRays;
    add_uncertainty(solution, fit);
  }
  return fit;
}

}  // namespace azimuth
