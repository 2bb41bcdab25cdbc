#include "slam/localisation/pose_from_directions.hpp"

#include <cmath>

namespace azimuth {
namespace {

constexpr double kSamePlace_m = 1e-3;
// Lower limit for the sine of the angle at which the two circles intersect.
constexpr double kTouching = 0.02;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/* Let q be landmark a relative to landmark b, and gamma the angle from a's direction to b's. The positions p (relative
 * to b) from which the landmarks are seen like this form a circle through both: Im[conj(q - p) (0 - p) e^(-i gamma)] =
 * 0, which is
 *   sin(gamma) |p|^2 = l . p,   l = (sin(gamma) q_x + cos(gamma) q_y, sin(gamma) q_y - cos(gamma) q_x) */
struct Circle {
  Eigen::Vector2d l;
  double sine;
};

Circle circle(const Eigen::Vector2d& q, const Eigen::Vector2d& to_a, const Eigen::Vector2d& to_b) {
  const double s = cross(to_a, to_b), c = to_a.dot(to_b);
  return {{s * q.x() + c * q.y(), s * q.y() - c * q.x()}, s};
}

/// The second intersection of two circles that both pass through the origin.
std::optional<Eigen::Vector2d> crossing(const Circle& a, const Circle& b) {
  const Eigen::Vector2d normal = b.sine * a.l - a.sine * b.l;  // normal of the line through both intersections
  if (normal.squaredNorm() <= kTouching * kTouching * std::sqrt(a.l.squaredNorm() * b.l.squaredNorm()))
    return std::nullopt;
  const Eigen::Vector2d line(-normal.y(), normal.x());
  const Circle& rounder = std::abs(a.sine) > std::abs(b.sine) ? a : b;
  if (std::abs(rounder.sine) < kTouching) return std::nullopt;
  return rounder.l.dot(line) / (rounder.sine * line.squaredNorm()) * line;
}

}  // namespace

std::optional<Pose2> pose_from_pair(const std::array<Eigen::Vector2d, 2>& p_map,
                                    const std::array<Eigen::Vector2d, 2>& p_body) {
  const Eigen::Vector2d in_map = p_map[1] - p_map[0], in_body = p_body[1] - p_body[0];
  if (in_map.norm() < kSamePlace_m || in_body.norm() < kSamePlace_m) return std::nullopt;
  Pose2 T_map_body{0.0, 0.0, std::atan2(cross(in_body, in_map), in_body.dot(in_map))};
  const Eigen::Vector2d p = 0.5 * (p_map[0] + p_map[1]) - T_map_body * Eigen::Vector2d(0.5 * (p_body[0] + p_body[1]));
  T_map_body.x_m = p.x();
  T_map_body.y_m = p.y();
  return T_map_body;
}

std::optional<Pose2> pose_from_directions(const std::array<Eigen::Vector2d, 3>& p_map,
                                          const std::array<Eigen::Vector2d, 3>& to_landmark) {
  const auto from_middle = crossing(circle(p_map[0] - p_map[1], to_landmark[0], to_landmark[1]),
                                    circle(p_map[2] - p_map[1], to_landmark[2], to_landmark[1]));
  if (!from_middle || from_middle->squaredNorm() < kSamePlace_m * kSamePlace_m) return std::nullopt;
  const Eigen::Vector2d p = p_map[1] + *from_middle, to_middle = -*from_middle;
  // Heading, times a length: the rotation of the middle direction to the middle landmark.
  const double c = to_landmark[1].dot(to_middle), s = cross(to_landmark[1], to_middle);
  for (const std::size_t i : {0u, 2u}) {
    const Eigen::Vector2d& d = to_landmark[i];
    if (!(Eigen::Vector2d(c * d.x() - s * d.y(), s * d.x() + c * d.y()).dot(p_map[i] - p) > 0.0)) return std::nullopt;
  }
  return Pose2{p.x(), p.y(), std::atan2(s, c)};
}

}  // namespace azimuth
