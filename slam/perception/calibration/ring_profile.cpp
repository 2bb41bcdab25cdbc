#include "slam/perception/calibration/ring_profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

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

}  // namespace azimuth
