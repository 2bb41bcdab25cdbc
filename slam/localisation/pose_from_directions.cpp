#include "slam/localisation/pose_from_directions.hpp"

#include <cmath>

namespace azimuth {
namespace {

constexpr double kSamePlace_m = 1e-3;
// The sine of the angle at which the two circles cross must be more than this.
constexpr double kTouching = 0.02;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/* Landmark a at q from landmark b, and gamma from a's azimuth to b's. The places p (from b) that see them so lie on a
 * circle through both: Im[conj(q - p) (0 - p) e^(-i gamma)] = 0, which is
 *   sin(gamma) |p|^2 = l . p,   l = (sin(gamma) q_x + cos(gamma) q_y, sin(gamma) q_y - cos(gamma) q_x) */
struct Circle {
  Eigen::Vector2d l;
  double sine;
};

Circle circle(const Eigen::Vector2d& q, double gamma_rad) {
  const double s = std::sin(gamma_rad), c = std::cos(gamma_rad);
  return {{s * q.x() + c * q.y(), s * q.y() - c * q.x()}, s};
}

/// The second crossing of two circles that both pass through the origin.
std::optional<Eigen::Vector2d> crossing(const Circle& a, const Circle& b) {
  const Eigen::Vector2d normal = b.sine * a.l - a.sine * b.l;  // of the line through both crossings
  if (normal.squaredNorm() <= kTouching * kTouching * a.l.norm() * b.l.norm()) return std::nullopt;
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

std::optional<Pose2> pose_from_azimuths(const std::array<Eigen::Vector2d, 3>& p_map,
                                        const std::array<double, 3>& azimuth_rad) {
  const Circle first = circle(p_map[0] - p_map[1], azimuth_rad[1] - azimuth_rad[0]);
  const Circle third = circle(p_map[2] - p_map[1], azimuth_rad[1] - azimuth_rad[2]);
  const auto from_middle = crossing(first, third);
  if (!from_middle || from_middle->norm() < kSamePlace_m) return std::nullopt;
  const Eigen::Vector2d p = p_map[1] + *from_middle;
  const double heading_rad = wrap(std::atan2(-from_middle->y(), -from_middle->x()) - azimuth_rad[1]);
  for (const std::size_t i : {0u, 2u}) {
    const Eigen::Vector2d direction(std::cos(heading_rad + azimuth_rad[i]), std::sin(heading_rad + azimuth_rad[i]));
    if (!(direction.dot(p_map[i] - p) > 0.0)) return std::nullopt;
  }
  return Pose2{p.x(), p.y(), heading_rad};
}

}  // namespace azimuth
