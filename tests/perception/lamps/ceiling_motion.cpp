#include "tests/perception/lamps/ceiling_motion.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace azimuth::test {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
constexpr double kGates_px[] = {12.0, 8.0, 5.0, 3.0};
constexpr double kHuber_px = 0.7;

std::size_t nearest(const Pixel& to, std::span<const Pixel> among, double within_px) {
  std::size_t best = kNone;
  for (std::size_t k = 0; k < among.size(); ++k) {
    const double distance_px = (among[k] - to).norm();
    if (distance_px >= within_px) continue;
    within_px = distance_px;
    best = k;
  }
  return best;
}

std::vector<SpotPair> pair(const std::vector<Pixel>& predicted, std::span<const Pixel> after, double gate_px) {
  std::vector<SpotPair> pairs;
  for (std::size_t k = 0; k < predicted.size(); ++k) {
    const std::size_t there = nearest(predicted[k], after, gate_px);
    if (there != kNone && nearest(after[there], predicted, gate_px) == k) pairs.push_back({k, there});
  }
  return pairs;
}

Pose2 pose(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// One Gauss-Newton step with Huber weights.
Eigen::Vector3d step(const TiltedFisheye& camera, std::span<const Pixel> before, std::span<const Pixel> after,
                     const std::vector<SpotPair>& pairs, const Eigen::Vector3d& at) {
  constexpr double kTiny = 1e-5;
  Eigen::Matrix3d information = 1e-9 * Eigen::Matrix3d::Identity();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (const SpotPair& each : pairs) {
    const auto point = camera.ceiling(before[each.before]);
    if (!point) continue;
    const Pixel predicted = camera.pixel(pose(at) * *point), off = predicted - after[each.after];
    Eigen::Matrix<double, 2, 3> J;
    for (int k = 0; k < 3; ++k)
      J.col(k) = (camera.pixel(pose(at + kTiny * Eigen::Vector3d::Unit(k)) * *point) - predicted) / kTiny;
    const double weight = kHuber_px / std::max(kHuber_px, off.norm());
    information += weight * J.transpose() * J;
    gradient += weight * J.transpose() * off;
  }
  return at - information.inverse() * gradient;
}

}  // namespace

std::optional<Eigen::Vector2d> TiltedFisheye::ceiling(const Pixel& pixel) const {
  const Eigen::Vector2d off = (pixel - Pixel(kCentreU_px, kCentreV_px)) / kFocalLength_px;
  const double radius = off.norm();
  double theta = radius;
  for (int i = 0; i < 20; ++i) theta = radius / (1.0 + kK1 * theta * theta);
  const Eigen::Vector2d across = radius > 0.0 ? Eigen::Vector2d(std::sin(theta) / radius * off) : off;
  const double cos = std::cos(kTilt_rad), sin = std::sin(kTilt_rad), along = std::cos(theta);
  const Eigen::Vector3d level(cos * across.x() + sin * along, across.y(), cos * along - sin * across.x());
  if (level.z() < std::sin(kLowest_rad)) return std::nullopt;
  return level.head<2>() / level.z();
}

Pixel TiltedFisheye::pixel(const Eigen::Vector2d& ceiling) const {
  const double cos = std::cos(kTilt_rad), sin = std::sin(kTilt_rad);
  const Eigen::Vector3d ray(cos * ceiling.x() - sin, ceiling.y(), sin * ceiling.x() + cos);
  const double across = ray.head<2>().norm(), theta = std::atan2(across, ray.z());
  const double radius_px = kFocalLength_px * theta * (1.0 + kK1 * theta * theta);
  return Pixel(kCentreU_px, kCentreV_px) + radius_px / std::max(across, 1e-12) * ray.head<2>();
}

std::optional<Pixel> moved(const TiltedFisheye& camera, const Pixel& before, const Pose2& T_after_before) {
  const auto point = camera.ceiling(before);
  if (!point) return std::nullopt;
  const Pixel after = camera.pixel(T_after_before * *point);
  return camera.ceiling(after) ? std::optional(after) : std::nullopt;
}

CeilingMotion fit_motion(const TiltedFisheye& camera, std::span<const Pixel> before, std::span<const Pixel> after,
                         const Pose2& guess) {
  constexpr int kSteps = 8;
  CeilingMotion motion{guess, {}};
  std::vector<Pixel> predicted(before.size());
  const auto match = [&](double gate_px) {
    for (std::size_t k = 0; k < before.size(); ++k)
      predicted[k] = moved(camera, before[k], motion.T_after_before).value_or(Pixel::Constant(1e9));
    motion.pairs = pair(predicted, after, gate_px);
  };
  for (const double gate_px : kGates_px) {
    match(gate_px);
    Eigen::Vector3d at = motion.T_after_before.vector();
    for (int i = 0; i < kSteps; ++i) at = step(camera, before, after, motion.pairs, at);
    motion.T_after_before = pose(at);
  }
  match(kGates_px[std::size(kGates_px) - 1]);
  return motion;
}

}  // namespace azimuth::test
