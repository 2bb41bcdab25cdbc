#include "slam/fastslam/cross_point.hpp"

#include <algorithm>
#include <cassert>

namespace azimuth {
namespace {

constexpr double kParallel = 1e-12;  // sin^2 of the angle between rays

/// Squared deviation of the detection from the direction of the point, in standard deviations.
double distance2(const Ray& ray, const Eigen::Vector3d& p_map) {
  return squared_distance(innovation(view(ray.from, p_map), ray.from, *ray.seen), ray.seen->covariance);
}

/// Sum of distance2() over all rays; nullopt if one of them is beyond the gate.
std::optional<double> agreed_distance2(std::span<const Ray> rays, const Eigen::Vector3d& p_map, double gate2) {
  double sum = 0.0;
  for (const Ray& ray : rays) {
    const double of_ray = distance2(ray, p_map);
    if (!(of_ray < gate2)) return std::nullopt;
    sum += of_ray;
  }
  return sum;
}

bool is_plausible(const Crossing& crossing, double height_m, const CrossingRules& rules) {
  return crossing.angle_rad > rules.min_parallax_rad && crossing.p_map.z() > height_m && crossing.along_first_m > 0.0 &&
         crossing.along_second_m > 0.0;
}

}  // namespace

Eigen::Vector3d Ray::direction() const {
  const double x = from.cos * seen->cos_azimuth() - from.sin * seen->sin_azimuth();
  const double y = from.sin * seen->cos_azimuth() + from.cos * seen->sin_azimuth();
  return {seen->sin_zenith() * x, seen->sin_zenith() * y, seen->cos_zenith()};
}

std::optional<Crossing> crossing(const Ray& first, const Ray& second) {
  const Eigen::Vector3d o1(first.from.x_m, first.from.y_m, first.from.z_m);
  const Eigen::Vector3d o2(second.from.x_m, second.from.y_m, second.from.z_m);
  const Eigen::Vector3d d1 = first.direction(), d2 = second.direction(), w = o1 - o2;
  const double b = d1.dot(d2);
  if (1.0 - b * b < kParallel) return std::nullopt;
  const double s1 = (b * d2.dot(w) - d1.dot(w)) / (1.0 - b * b);
  const double s2 = (d2.dot(w) - b * d1.dot(w)) / (1.0 - b * b);
  const Eigen::Vector3d foot1 = o1 + s1 * d1, foot2 = o2 + s2 * d2;
  return Crossing{0.5 * (foot1 + foot2), s1, s2, (foot1 - foot2).norm(), std::acos(std::clamp(b, -1.0, 1.0))};
}

void CrossPoints::observe(std::span<const Ray> rays, const CrossingRules& rules) {
  const Ray& current = rays.back();
  const double gate2 = rules.gate_sigmas * rules.gate_sigmas;
  const double wide_enough = std::cos(rules.min_parallax_rad);
  const Eigen::Vector3d direction = current.direction();
  drop_contradicted(current, gate2);
  with_current_ = 0;
  for (const Ray& earlier : rays.first(rays.size() - 1)) {
    if (direction.dot(earlier.direction()) > wide_enough) continue;  // Early exit that saves most of the work
    const std::optional<Crossing> met = crossing(earlier, current);
    if (!met || !is_plausible(*met, current.from.z_m, rules)) continue;
    const std::optional<double> sum = agreed_distance2(rays, met->p_map, gate2);
    if (!sum) continue;
    ++with_current_;
    add({met->p_map, *sum});
  }
}

void CrossPoints::drop_contradicted(const Ray& current, double gate2) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const double of_ray = distance2(current, points_[i].p_map);
    if (!(of_ray < gate2)) continue;
    points_[kept++] = {points_[i].p_map, points_[i].distance2 + of_ray};
  }
  count_ = kept;
}

void CrossPoints::add(const Point& point) {
  if (count_ < kMost) {
    points_[count_++] = point;
    return;
  }
  const auto worst = std::ranges::max_element(points_, {}, &Point::distance2);
  if (point.distance2 < worst->distance2) *worst = point;
}

const Eigen::Vector3d& CrossPoints::best() const {
  assert(count_ > 0);
  const auto points = std::span(points_).first(count_);
  return std::ranges::min_element(points, {}, &Point::distance2)->p_map;
}

}  // namespace azimuth
