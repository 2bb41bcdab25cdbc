#include "slam/geometry/rigid_alignment.hpp"

#include <cassert>
#include <cmath>

namespace azimuth {
namespace {

Eigen::Vector2d centroid(std::span<const Eigen::Vector2d> points) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const auto& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

}  // namespace

Pose2 align(std::span<const Eigen::Vector2d> from, std::span<const Eigen::Vector2d> to) {
  assert(from.size() == to.size());
  if (from.empty()) return {};
  const Eigen::Vector2d centre_from = centroid(from), centre_to = centroid(to);
  // In the plane the best rotation is the angle of the summed complex products conj(from) * to.
  double cosine = 0.0, sine = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Eigen::Vector2d a = from[i] - centre_from, b = to[i] - centre_to;
    cosine += a.dot(b);
    sine += a.x() * b.y() - a.y() * b.x();
  }
  const Pose2 rotation{0.0, 0.0, wrap(std::atan2(sine, cosine))};
  const Eigen::Vector2d translation = centre_to - rotation * centre_from;
  return {translation.x(), translation.y(), rotation.heading_rad};
}

}  // namespace azimuth
